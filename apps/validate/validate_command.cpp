#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/command.hpp"
#include "cli/inputs_json.hpp"
#include "cli/interruptible_run.hpp"
#include "cli/shared_options.hpp"
#include "options/command_line.hpp"
#include "options/volume_fields.hpp"
#include "plan/plan_input.hpp"
#include "plan/plan_options.hpp"
#include "process/result_output.hpp"
#include "version.hpp"

namespace vantage {
namespace {

struct ValidateCommand {
  PlanOptions plan;
  bool json = false;
  int threads = 0;
};

std::string text_of(const PlanInput& input) {
  const auto depths = std::ranges::count_if(
      input.world.cameras, [](const DepthCamera& camera) { return camera.depth != nullptr; });
  std::string text = fmt::format(
      "cameras    {}, {} of them with depth\nobjects    {} ({}), {} static structures\n",
      input.world.cameras.size(), depths, input.world.objects.size(),
      input.record.config["objects"].get<std::string>(), input.world.static_structures.size());
  text += input.warnings.empty() ? "findings   none\n"
                                 : fmt::format("findings   {}\n", input.warnings.size());
  for (const std::string& finding : input.warnings) text += "  " + finding + "\n";
  return text;
}

nlohmann::ordered_json json_of(const PlanInput& input) {
  return {{"vantage", kVersion},
          {"cameras", input.world.cameras.size()},
          {"objects", input.world.objects.size()},
          {"static_structures", input.world.static_structures.size()},
          {"findings", input.warnings},
          {"config", input.record.config},
          {"inputs", inputs_json(input.record.inputs)}};
}

ExitCode validate(const ValidateCommand& command) {
  InterruptibleRun run(command.threads);
  const PlanInput input =
      run.execute("validating", [&] { return load_plan_input(command.plan, run.stop()); });
  if (run.cancelled()) return ExitCode::cancelled;
  print_result(command.json, json_of(input), [&] { return text_of(input); });
  return input.warnings.empty() ? ExitCode::ok : ExitCode::bad_input;
}

}  // namespace

void add_validate_command(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("validate",
                         "Check whether a recording and a workcell fit together, without planning: "
                         "exit code 0 without findings, 3 with findings");
  const auto command = std::make_shared<ValidateCommand>();
  add_input_options(*verb, command->plan);
  Workcell defaults{.work_area = Box({0, 0, 0}, {1, 1, 1})};
  const FieldGroup volume{"", "Work area", {voxel_size_field(defaults.voxel_size_m)}, {}};
  add_fields(*verb, volume, command->plan.given);
  add_object_options(*verb, command->plan.objects);
  add_json_flag(*verb, command->json, "the findings");
  add_threads_option(*verb, command->threads);
  verb->footer(
      "Examples:\n"
      "  vantage validate my_cell --workcell cell.yaml\n"
      "  vantage validate my_cell --work-area -0.4 -0.3 0.01 0.4 0.3 0.3\n"
      "  vantage validate my_cell --workcell cell.yaml --cameras board --json");
  set_action(*verb, action, command, validate);
}

}  // namespace vantage
