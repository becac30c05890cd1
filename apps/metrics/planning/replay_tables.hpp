#pragma once

#include <vector>

#include "metrics/planning/replay_evaluation.hpp"
#include "metrics/plot/report_table.hpp"

namespace vantage {

/// A table for each method, pair by pair, and one of means.
std::vector<ReportTable> replay_tables(const ReplayEvaluation& evaluation);

}  // namespace vantage
