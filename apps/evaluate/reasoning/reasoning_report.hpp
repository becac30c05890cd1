#pragma once

#include <nlohmann/json.hpp>

#include "evaluate/reasoning/reasoning_benchmark.hpp"
#include "metrics/plot/report_table.hpp"

namespace vantage {

/// reasoning.json, as assets/schema/reasoning.schema.json describes it; `config` and `inputs` are
/// the caller's to add. The same bytes for the same evaluation.
nlohmann::ordered_json reasoning_to_json(const ReasoningEvaluation& evaluation);

/// Phantoms and recall with all evidence, and with all but one kind.
ReportTable reasoning_table(const ReasoningEvaluation& evaluation);

}  // namespace vantage
