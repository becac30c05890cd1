// The command `vantage VERB`: parses, runs the verb, and turns errors into exit codes.

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "cli/command.hpp"
#include "cli/help_formatter.hpp"
#include "process/printable_text.hpp"
#include "process/process_setup.hpp"
#include "process/result_output.hpp"
#include "process/usage_error.hpp"
#include "vantage/raycore/detail/instruction_set.hpp"
#include "version.hpp"

namespace {

using namespace vantage;

void add_commands(CLI::App& app, Action& action) {
  app.set_version_flag("--version", vantage::kVersion);
  app.require_subcommand(1);
  set_up_help(app);
  add_plan_command(app, action);
  add_demo_command(app, action);
  add_reconstruct_command(app, action);
  add_validate_command(app, action);
  add_simulate_command(app, action);
  add_import_command(app, action);
  add_render_command(app, action);
  add_evaluate_command(app, action);
}

/// No file, folder or name that an option takes is empty; a shell variable that is not set is.
void refuse_empty_values(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->count() == 0 || option->get_expected_max() == 0) continue;
    for (const std::string& value : option->results()) {
      if (!value.empty()) continue;
      throw UsageError(option->get_name() + ": found an empty text; give a value, or leave it out");
    }
  }
  for (const CLI::App* verb : app.get_subcommands()) refuse_empty_values(*verb);
}

/// Help and versions go to stdout, mistakes to stderr.
ExitCode answer(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream out, err;
  const bool asked = app.exit(error, out, err) == 0;
  std::cerr << printable(shortened(err.str())) << std::flush;
  if (asked) print_text(out.str());
  return asked ? ExitCode::ok : ExitCode::usage;
}

ExitCode run(int argc, char** argv) {
  CLI::App app("vantage: where should the robot's camera look next?", "vantage");
  Action action;
  add_commands(app, action);
  try {
    std::vector<std::string> arguments = plain_arguments(argc, argv);
    std::reverse(arguments.begin() + 1, arguments.end());  // as this overload of parse wants them
    app.parse(std::vector<std::string>(arguments.begin() + 1, arguments.end()));
  } catch (const CLI::ParseError& error) {
    return answer(app, error);
  }
  refuse_empty_values(app);
  instruction_set();  // a wrong VANTAGE_MAX_ISA is said before any work
  return action();
}

/// Turns what was thrown into a message and an exit code.
ExitCode run_guarded(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const Error& error) {
    spdlog::error("{}", error.what());
    return exit_code_of(error.code());
  } catch (const UsageError& error) {
    spdlog::error("{}", error.what());
    return ExitCode::usage;
  } catch (const std::bad_alloc&) {
    spdlog::error("out of memory: use larger voxels, or fewer images");
    return ExitCode::out_of_resources;
  } catch (const std::filesystem::filesystem_error& error) {  // e.g. a folder that we may not read
    spdlog::error("{}", error.what());
    const bool used_up = error.code() == std::errc::no_space_on_device ||
                         error.code() == std::errc::too_many_files_open ||
                         error.code() == std::errc::not_enough_memory;
    return used_up ? ExitCode::out_of_resources : ExitCode::bad_input;
  } catch (const std::exception& error) {
    if (const std::string resource = used_up_resource(error); !resource.empty()) {
      spdlog::error("the system gives no more {}", resource);
      return ExitCode::out_of_resources;
    }
    spdlog::error("this is a bug of vantage, please report it: {}", error.what());
    return ExitCode::failure;
  }
}

}  // namespace

int main(int argc, char** argv) {
  vantage::set_up_process(int(vantage::ExitCode::out_of_resources));
  return int(run_guarded(argc, argv));
}
