#include <memory>

#include "cli/command.hpp"
#include "cli/interruptible_run.hpp"
#include "cli/number_checks.hpp"
#include "cli/shared_options.hpp"
#include "evaluate/gain/true_gain.hpp"
#include "process/result_output.hpp"

namespace vantage {
namespace {

constexpr const char* kGainExamples =
    "Examples:\n"
    "  vantage evaluate gain data/workcell.yaml out/plan.json\n"
    "  vantage evaluate gain data/workcell.yaml out/plan.json --oracle none --json\n"
    "  vantage evaluate gain data/workcell.yaml out/plan.json --oracle full --seed 7";

struct GainCommandOptions {
  std::filesystem::path workcell, plan;
  std::string oracle = "plan";
  std::uint64_t seed = TrueGainOptions().seed;
  std::optional<double> voxel_size_m;
  bool json = false;
  int threads = 0;

  TrueGainOptions chosen() const {
    const GainOracle kind = oracle == "none"   ? GainOracle::none
                            : oracle == "full" ? GainOracle::full
                                               : GainOracle::plan;
    return {kind, seed, voxel_size_m};
  }
};

ExitCode evaluate_gain(const GainCommandOptions& options) {
  InterruptibleRun run(options.threads);
  const auto gain = run.execute("measuring", [&] {
    return true_gain(options.workcell, options.plan, options.chosen(), run.stop());
  });
  if (run.cancelled()) return ExitCode::cancelled;
  print_result(options.json, gain, [&] { return summary_of_true_gain(gain); });
  return ExitCode::ok;
}

}  // namespace

void add_evaluate_gain(CLI::App& evaluate_verb, Action& action) {
  CLI::App* verb = evaluate_verb.add_subcommand(
      "gain",
      "Measure how much shadow a plan's views really turn free or occupied in a simulated cell, "
      "and compare it with the plan's bound and expectation");
  const auto options = std::make_shared<GainCommandOptions>();
  verb->add_option("workcell", options->workcell,
                   "workcell.yaml of the simulated dataset, which holds the ground truth")
      ->required();
  verb->add_option("plan", options->plan, "plan.json")->required();
  verb->add_option("--oracle", options->oracle,
                   "Views to search for the truly best one; plan: the plan's own candidates; full: "
                   "the full set of 34,225 as well; none: no search")
      ->check(CLI::IsMember({"none", "plan", "full"}))
      ->capture_default_str();
  verb->add_option("--seed", options->seed, "Random seed for the movable camera's noise")
      ->capture_default_str();
  verb->add_option("--voxel-size", options->voxel_size_m,
                   "Edge length of the voxels that the truly hidden volume is counted in, metres "
                   "(default: the plan's)")
      ->check(positive_number());
  add_json_flag(*verb, options->json, "JSON");
  add_threads_option(*verb, options->threads);
  verb->footer(kGainExamples);
  set_action(*verb, action, options, evaluate_gain);
}

}  // namespace vantage
