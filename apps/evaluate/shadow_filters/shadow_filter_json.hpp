#pragma once

#include <nlohmann/json.hpp>

#include "metrics/planning/shadow_filter_evaluation.hpp"

namespace vantage {

/// As assets/schema/shadow_filters.schema.json describes it; `config` and `inputs` are the caller's
/// to add. The same for the same input.
nlohmann::ordered_json to_json(const ShadowFilterEvaluation& evaluation);

}  // namespace vantage
