#pragma once

#include <nlohmann/json.hpp>

#include "metrics/planning/planning_evaluation.hpp"

namespace vantage {

/// planning.json as assets/schema/planning.schema.json describes it; `config` and `inputs`, and a
/// scene's `config`, are the caller's to add. All but `timing` is the same for the same input.
nlohmann::ordered_json planning_to_json(const PlanningEvaluation& evaluation);

/// What the thesis printed of it, as numbers.
nlohmann::ordered_json thesis_planning_json();

}  // namespace vantage
