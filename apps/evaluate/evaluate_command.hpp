#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace vantage {

/// Holds the best view of a plan against the truth of the simulated cell that it was made for.
/// @param workcell_file the simulated dataset's workcell.yaml.
/// @param plan_file plan.json.
/// @param voxel_size_m of the truth; none: the plan's.
/// @returns promised_m3, true_gain_m3 (truly hidden volume that the view really sees),
/// true_hidden_m3, and their quotients.
/// @throws Error as `load_workcell` does; bad_input for a file that is no plan.json, or whose plan
/// has no best view.
nlohmann::ordered_json true_gain(const std::filesystem::path& workcell_file,
                                 const std::filesystem::path& plan_file,
                                 std::optional<double> voxel_size_m);

/// The same for people.
std::string summary_of_true_gain(const nlohmann::ordered_json& gain);

}  // namespace vantage
