#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// Which views a plan's are compared with.
enum class GainOracle {
  none,
  plan,  ///< its own candidates that are feasible, and those that it ranked
  full,  ///< the thesis' full set as well, 34,225 views, as far as they may be the best
};

struct TrueGainOptions {
  GainOracle oracle = GainOracle::plan;
  std::uint64_t seed = 1000;  ///< of the movable camera's noise
  /// Of the truth, in which hidden volume is counted; none: the plan's.
  std::optional<double> voxel_size_m = {};
};

/// Compares a plan with the ground truth of the simulated cell that it was made for: its views are
/// taken in their order, with its own images, work area, sensor and filter, and what really turns
/// from shadow to free or occupied counts. Runs in the caller's task arena.
/// @param workcell_file the simulated dataset's workcell.yaml.
/// @param plan_file plan.json of that dataset.
/// @returns `views` with promised_m3, expected_m3, expected_interval_m3, true_gain_m3 and
/// best_true_gain_m3 (the most that any view of the oracle would have gained then; null without
/// one), the first view's promise and true gain again, and of the truth true_hidden_m3 and the part
/// of it in the first view's sight.
/// @throws Error as `load_workcell` and `load_plan_input` do; bad_input for a file that is not a
/// plan.json, for one of another cell or dataset, and for one without a best view.
nlohmann::ordered_json true_gain(const std::filesystem::path& workcell_file,
                                 const std::filesystem::path& plan_file,
                                 const TrueGainOptions& options = {}, const StopToken& stop = {});

/// The same for people.
std::string summary_of_true_gain(const nlohmann::ordered_json& gain);

}  // namespace vantage
