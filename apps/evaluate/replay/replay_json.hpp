#pragma once

#include <nlohmann/json.hpp>

#include "metrics/planning/replay_evaluation.hpp"

namespace vantage {

/// replay.json as assets/schema/replay.schema.json describes it; `config` and `inputs` are the
/// caller's to add. The same bytes for the same evaluation: no times are in it.
nlohmann::ordered_json replay_to_json(const ReplayEvaluation& evaluation);

}  // namespace vantage
