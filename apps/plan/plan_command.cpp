#include <spdlog/spdlog.h>

#include <memory>

#include "cli/command.hpp"
#include "cli/signal_handler.hpp"
#include "cli/workers.hpp"
#include "options/command_line.hpp"
#include "options/view_options.hpp"
#include "plan/plan_input.hpp"
#include "plan/plan_options.hpp"
#include "plan/run_options.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  vantage plan my_cell --work-area -0.4 -0.3 0.01 0.4 0.3 0.3 -o out --pictures\n"
    "  vantage plan my_cell --workcell cell.yaml --objects pnp --voxel-size 0.005 -o out\n"
    "  vantage plan my_cell --workcell cell.yaml --method mesh --views 3 --deadline-ms 500 --json";

struct PlanCommandOptions {
  PlanOptions plan;
  CommonOptions common;
};

void add_planning_options(CLI::App& verb, PlanCommandOptions& options) {
  options.plan.candidates.add_to(verb);
  ViewOptions views;
  add_fields(verb, fields_of(views), options.plan.given);
}

void add_output_options(CLI::App& verb, PlanCommandOptions& options) {
  options.common.add_to(verb);
  OutputOptions& output = options.common.output;
  verb.add_option(
          "--explain", output.explain,
          "Explain these candidates, e.g. 17,3: their scores, the shadow that they reveal, and "
          "why they lost")
      ->delimiter(',')
      ->group("Output");
  verb.add_flag(
          "--pictures", output.pictures,
          "Write overview.png, and what each suggested camera would see: view.png, view_2.png …")
      ->needs(verb.get_option("--output"))
      ->group("Output");
}

/// Without pictures these change nothing; the plan is the same, so a warning is enough.
std::vector<std::string> idle_picture_options(const CLI::App& verb, bool pictures) {
  std::vector<std::string> idle;
  for (const char* option : {"--picture-quality", "--picture-width"}) {
    if (!pictures && verb.get_option(option)->count() > 0) idle.emplace_back(option);
  }
  return idle;
}

ExitCode plan(const PlanCommandOptions& options) {
  const auto start = StopToken::Clock::now();
  const RunOptions run = options.common.run(start);
  const SignalHandler interrupt(run.tokens());
  PlanInput input = Workers(options.common.threads).execute([&] {
    return load_plan_input(options.plan, run.stop);
  });
  for (const std::string& warning : input.warnings) spdlog::warn("{}", warning);
  input.record.config["deadline_ms"] = options.common.deadline_ms
                                           ? nlohmann::ordered_json(*options.common.deadline_ms)
                                           : nlohmann::ordered_json();
  return run_plan(input.world, input.request, input.record, options.common.output, run, start);
}

}  // namespace

void add_plan_command(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("plan", "Find the next view for a recording");
  const auto options = std::make_shared<PlanCommandOptions>();
  options->plan.refuse_unused = true;
  add_input_options(*verb, options->plan);
  add_volume_options(*verb, options->plan);
  add_object_options(*verb, options->plan.objects);
  add_planning_options(*verb, *options);
  add_output_options(*verb, *options);
  verb->footer(kExamples);
  verb->parse_complete_callback([&action, options, verb] {
    const auto idle = idle_picture_options(*verb, options->common.output.pictures);
    action = [=] {
      for (const std::string& option : idle) {
        spdlog::warn("{} does nothing without --pictures", option);
      }
      return plan(*options);
    };
  });
}

}  // namespace vantage
