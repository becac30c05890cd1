#include "cli/command.hpp"

namespace vantage {

void add_evaluate_command(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("evaluate", "Compare results with the ground truth");
  verb->require_subcommand(1);
  add_evaluate_gain(*verb, action);
  add_evaluate_expected_gain(*verb, action);
  add_evaluate_planning(*verb, action);
  add_evaluate_reconstruction(*verb, action);
  add_evaluate_shadow_filters(*verb, action);
  add_evaluate_replay(*verb, action);
  add_evaluate_tracking(*verb, action);
  add_evaluate_reasoning(*verb, action);
  add_evaluate_stability(*verb, action);
}

}  // namespace vantage
