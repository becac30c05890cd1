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

struct PlanArguments {
  PlanOptions plan;
  CommonOptions common;
  MethodArguments method;
};

void add_planning_options(CLI::App& verb, PlanArguments& arguments) {
  arguments.plan.candidates.add_to(verb);
  arguments.method.add_to(verb);
  OutputOptions& output = arguments.common.output;
  verb.add_option("--explain", output.explain,
                  "Explain these candidates, e.g. 17,3: what makes their scores, which shadow they "
                  "reveal, and why they lost")
      ->delimiter(',');
  verb.add_flag("--pictures", output.pictures, "Write overview.png and view.png")
      ->needs(verb.get_option("--output"));
}

ExitCode plan(const PlanArguments& arguments) {
  const auto start = StopToken::Clock::now();
  const RunOptions run = arguments.common.run(start);
  const Interrupt interrupt({run.stop, run.drawing});
  PlanInput input = Workers(arguments.common.threads).execute([&] {
    return load_plan_input(arguments.plan, run.stop);
  });
  arguments.method.apply(input.request);
  for (const std::string& warning : input.warnings) spdlog::warn("{}", warning);
  input.record.config["deadline_ms"] = arguments.common.deadline_ms
                                           ? nlohmann::ordered_json(*arguments.common.deadline_ms)
                                           : nlohmann::ordered_json();
  return run_plan(input.world, input.request, input.record, arguments.common.output, run, start);
}

}  // namespace

void add_plan_command(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("plan", "Find the next view for a recording");
  const auto arguments = std::make_shared<PlanArguments>();
  arguments->common.add_to(*verb);
  add_input_options(*verb, arguments->plan);
  add_object_options(*verb, arguments->plan.objects);
  add_planning_options(*verb, *arguments);
  add_volume_options(*verb, arguments->plan);
  verb->parse_complete_callback(
      [&action, arguments] { action = [=] { return plan(*arguments); }; });
}

}  // namespace vantage
