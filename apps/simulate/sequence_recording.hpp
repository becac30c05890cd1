#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "simulate/simulated_dataset.hpp"
#include "simulator/sequence/sequence_plan.hpp"

namespace vantage {

/// `sequence.json` of a recording, as assets/schema/sequence.schema.json describes it: times, what
/// truly stands where, and what happens. The same bytes for the same plan.
nlohmann::ordered_json sequence_to_json(const SequencePlan& plan, const Workcell& workcell);

/// The folder of an instant, e.g. "000012".
std::string instant_folder(int instant);

/// Records every instant as a BOP scene folder of its own below `folder`; models and calibration
/// are shared beside them. `sequence.json` comes last: a folder without it is no sequence yet.
/// @returns whether it is complete: not if `stop` asked to stop.
/// @throws Error as `record` does.
bool record_sequence(const Workcell& workcell, const SequencePlan& plan,
                     const RecordingOptions& options, const std::filesystem::path& folder,
                     const StopToken& stop = {});

}  // namespace vantage
