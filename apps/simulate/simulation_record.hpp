#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "simulate/simulated_dataset.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

/// What `vantage simulate` was asked for.
struct SimulationOptions {
  RecordingOptions recording = {};
  std::optional<std::uint64_t> seed = {};  ///< none: the workcell's for objects, 0 for noise
  std::optional<int> objects = {};         ///< how many random ones; none: as the workcell says
  std::vector<std::string> types = {};     ///< of them; empty: the workcell's, else all
};

/// Puts the random objects into the workcell, and the seed into the recording's options.
/// @throws Error bad_input for types that the knowledge base does not have, and as
/// `place_random_objects` does.
void prepare_objects(Workcell& workcell, SimulationOptions& settings);

/// Makes the folder for a dataset. One that is there has to be empty, or an earlier simulation:
/// that is no recording any more from now on, until the new one is complete.
/// @throws Error bad_input if something else is in it.
void claim_folder(const std::filesystem::path& folder);

/// Writes what else belongs to a simulated dataset: `workcell.yaml`, to be planned with, `cell/`,
/// and `simulation.json`: settings, hashes of the inputs, and the cell's true volumes.
/// @returns simulation.json.
nlohmann::ordered_json write_simulation_record(const std::filesystem::path& workcell_file,
                                               const Workcell& workcell, const SimulatedCell& cell,
                                               const SimulationOptions& settings,
                                               const std::filesystem::path& folder);

/// The same for people.
std::string summary_of_simulation(const nlohmann::ordered_json& record);

}  // namespace vantage
