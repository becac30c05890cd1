#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>

#include "exit_code.hpp"
#include "run_plan.hpp"

namespace vantage {

/// What the verb on the command line does; set by the verb's callback while parsing.
using Action = std::function<ExitCode()>;

void add_plan_command(CLI::App& app, Action& action);
void add_demo_command(CLI::App& app, Action& action);
void add_simulate_command(CLI::App& app, Action& action);
void add_reconstruct_command(CLI::App& app, Action& action);
void add_render_command(CLI::App& app, Action& action);
void add_evaluate_command(CLI::App& app, Action& action);
void add_evaluate_planning(CLI::App& evaluate_verb, Action& action);
void add_evaluate_reconstruction(CLI::App& evaluate_verb, Action& action);
void add_evaluate_shadow_filters(CLI::App& evaluate_verb, Action& action);
void add_evaluate_replay(CLI::App& evaluate_verb, Action& action);

/// Options that verbs share.
struct CommonOptions {
  OutputOptions output;
  int threads = 0;
  std::optional<double> deadline_ms;

  void add_to(CLI::App& verb);

  /// The deadline counts from `start`.
  RunOptions run(StopToken::Clock::time_point start) const;
};

}  // namespace vantage
