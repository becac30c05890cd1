#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <type_traits>

#include "cli/exit_code.hpp"

namespace vantage {

/// What the verb on the command line does; set by the verb's callback while parsing.
using Action = std::function<ExitCode()>;

/// Makes `run` the action if the command line has this verb; parsing fills `options` before.
template <class Options>
void set_action(CLI::App& verb, Action& action, const std::shared_ptr<Options>& options,
                ExitCode (*run)(std::type_identity_t<const Options&>)) {
  verb.parse_complete_callback(
      [&action, options, run] { action = [options, run] { return run(*options); }; });
}

void add_plan_command(CLI::App& app, Action& action);
void add_demo_command(CLI::App& app, Action& action);
void add_validate_command(CLI::App& app, Action& action);
void add_simulate_command(CLI::App& app, Action& action);
void add_reconstruct_command(CLI::App& app, Action& action);
void add_track_command(CLI::App& app, Action& action);
void add_render_command(CLI::App& app, Action& action);
void add_import_command(CLI::App& app, Action& action);
void add_evaluate_command(CLI::App& app, Action& action);
void add_evaluate_planning(CLI::App& evaluate_verb, Action& action);
void add_evaluate_reconstruction(CLI::App& evaluate_verb, Action& action);
void add_evaluate_shadow_filters(CLI::App& evaluate_verb, Action& action);
void add_evaluate_replay(CLI::App& evaluate_verb, Action& action);
void add_evaluate_gain(CLI::App& evaluate_verb, Action& action);
void add_evaluate_expected_gain(CLI::App& evaluate_verb, Action& action);
void add_evaluate_tracking(CLI::App& evaluate_verb, Action& action);
void add_evaluate_reasoning(CLI::App& evaluate_verb, Action& action);
void add_evaluate_stability(CLI::App& evaluate_verb, Action& action);

}  // namespace vantage
