// The command `vantage VERB`: parses, runs the verb, and turns errors into exit codes.

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <new>

#include "cli/command.hpp"
#include "cli/help_formatter.hpp"
#include "vantage/raycore/detail/instruction_set.hpp"
#include "version.hpp"

namespace {

using namespace vantage;

/// Messages go to stderr; stdout is for the result.
void set_up_log() {
  const auto logger = spdlog::stderr_color_st("vantage");
  logger->set_pattern("%^%l:%$ %v");
  spdlog::set_default_logger(logger);
}

ExitCode run(const Action& action) {
  try {
    instruction_set();  // a wrong VANTAGE_MAX_ISA is said before any work
    return action();
  } catch (const Error& error) {
    spdlog::error("{}", error.what());
    return exit_code_of(error.code());
  } catch (const std::filesystem::filesystem_error& error) {  // e.g. a folder that we may not read
    spdlog::error("{}", error.what());
    return ExitCode::bad_input;
  } catch (const std::bad_alloc&) {
    spdlog::error("out of memory: use larger voxels, or fewer images");
    return ExitCode::out_of_resources;
  } catch (const std::exception& error) {
    spdlog::error("this is a bug of vantage, please report it: {}", error.what());
    return ExitCode::failure;
  }
}

}  // namespace

int main(int argc, char** argv) {
  set_up_log();
  CLI::App app("vantage: where should the robot's camera look next?", "vantage");
  app.set_version_flag("--version", vantage::kVersion);
  app.require_subcommand(1);
  set_up_help(app);
  Action action;
  add_plan_command(app, action);
  add_demo_command(app, action);
  add_reconstruct_command(app, action);
  add_validate_command(app, action);
  add_simulate_command(app, action);
  add_render_command(app, action);
  add_import_command(app, action);
  add_evaluate_command(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool asked = app.exit(error) == 0;  // --help, --version
    return int(asked ? ExitCode::ok : ExitCode::usage);
  }
  return int(run(action));
}
