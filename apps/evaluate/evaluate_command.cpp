#include <iostream>
#include <memory>

#include "cli/command.hpp"
#include "cli/number_checks.hpp"
#include "evaluate/true_gain.hpp"

namespace vantage {
namespace {

struct GainArguments {
  std::filesystem::path workcell, plan;
  std::optional<double> voxel_size_m;
  bool json = false;
};

ExitCode evaluate_gain(const GainArguments& arguments) {
  const auto gain = true_gain(arguments.workcell, arguments.plan, arguments.voxel_size_m);
  std::cout << (arguments.json ? gain.dump(1) + "\n" : summary_of_true_gain(gain)) << std::flush;
  return ExitCode::ok;
}

void add_gain(CLI::App& evaluate, Action& action) {
  CLI::App* verb = evaluate.add_subcommand(
      "gain", "What a plan's best view really reveals of a simulated cell, beside its promise");
  const auto arguments = std::make_shared<GainArguments>();
  verb->add_option("workcell", arguments->workcell,
                   "The simulated dataset's workcell.yaml: what truly stands there")
      ->required();
  verb->add_option("plan", arguments->plan, "plan.json")->required();
  verb->add_option("--voxel-size", arguments->voxel_size_m,
                   "Edge of a voxel of the truth, metres; the plan's without it")
      ->check(positive_number());
  verb->add_flag("--json", arguments->json, "Print JSON instead of a summary");
  verb->parse_complete_callback(
      [&action, arguments] { action = [=] { return evaluate_gain(*arguments); }; });
}

}  // namespace

void add_evaluate_command(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("evaluate", "Hold results against the truth");
  verb->require_subcommand(1);
  add_gain(*verb, action);
  add_evaluate_planning(*verb, action);
  add_evaluate_reconstruction(*verb, action);
  add_evaluate_shadow_filters(*verb, action);
  add_evaluate_replay(*verb, action);
}

}  // namespace vantage
