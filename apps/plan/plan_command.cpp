#include <spdlog/spdlog.h>

#include <memory>

#include "cli/command.hpp"
#include "cli/signal_handler.hpp"
#include "cli/workers.hpp"
#include "plan/method_options.hpp"
#include "plan/plan_input.hpp"
#include "plan/plan_options.hpp"
#include "plan/run_options.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

struct PlanCommandOptions {
  PlanOptions plan;
  CommonOptions common;
  ViewOptions method;
};

void add_planning_options(CLI::App& verb, PlanCommandOptions& options) {
  options.plan.candidates.add_to(verb);
  options.method.add_to(verb);
  OutputOptions& output = options.common.output;
  verb.add_option("--explain", output.explain,
                  "Explain these candidates, e.g. 17,3: what makes their scores, which shadow they "
                  "reveal, and why they lost")
      ->delimiter(',');
  verb.add_flag("--pictures", output.pictures, "Write overview.png and view.png")
      ->needs(verb.get_option("--output"));
}

ExitCode plan(const PlanCommandOptions& options) {
  const auto start = StopToken::Clock::now();
  const RunOptions run = options.common.run(start);
  const SignalHandler interrupt({run.stop, run.drawing});
  PlanInput input = Workers(options.common.threads).execute([&] {
    return load_plan_input(options.plan, run.stop);
  });
  options.method.apply(input.request);
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
  options->common.add_to(*verb);
  add_input_options(*verb, options->plan);
  add_object_options(*verb, options->plan.objects);
  add_planning_options(*verb, *options);
  add_volume_options(*verb, options->plan);
  verb->parse_complete_callback([&action, options] { action = [=] { return plan(*options); }; });
}

}  // namespace vantage
