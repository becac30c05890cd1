#pragma once

#include <nlohmann/json.hpp>

#include "evaluate/stability/stability_benchmark.hpp"
#include "metrics/plot/report_table.hpp"

namespace vantage {

/// stability.json, as assets/schema/stability.schema.json describes it; `config` and `inputs` are
/// the caller's to add.
nlohmann::ordered_json stability_to_json(const StabilityEvaluation& evaluation);

/// The same for people.
std::vector<ReportTable> stability_tables(const StabilityEvaluation& evaluation);

}  // namespace vantage
