#pragma once

#include <nlohmann/json.hpp>

#include "evaluate/tracking/tracking_benchmark.hpp"
#include "metrics/plot/report_table.hpp"

namespace vantage {

/// tracking.json, as assets/schema/tracking.schema.json describes it; `config` and `inputs` are the
/// caller's to add. The same bytes for the same evaluation.
nlohmann::ordered_json tracking_to_json(const TrackingEvaluation& evaluation);

/// Figures of every tracker, and which of the goals they reach.
std::vector<ReportTable> tracking_tables(const TrackingEvaluation& evaluation);

/// What tracking has to reach, and whether it does.
struct TrackingGoal {
  std::string name;   ///< as people write it, e.g. "HOTA >= 0.95"
  std::string found;  ///< likewise
  bool reached = false;
};

std::vector<TrackingGoal> tracking_goals(const TrackingScores& scores);

}  // namespace vantage
