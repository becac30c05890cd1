#pragma once

#include <span>
#include <string>
#include <vector>

#include "evaluate/expected_gain/gain_benchmark.hpp"
#include "metrics/plot/report_table.hpp"

namespace vantage {

/// The quality of one method's picks, over the cells in which it picked a view.
struct GainSummary {
  std::string method;
  std::size_t cells = 0;
  double median_ratio = 0;   ///< of gained to expected
  double within = 0;         ///< share of the cells with 0.7 <= ratio <= 1.4
  double covered = 0;        ///< share of the cells whose gain is in its interval
  double share_of_best = 0;  ///< mean of gained / the best view's gain; 0 where that is not known
  double min_share_of_best = 0;
};

/// In the order of the first cell's picks.
std::vector<GainSummary> gain_summaries(std::span<const CellGains> cells);

/// Every cell's picks, and the summaries.
std::vector<ReportTable> gain_tables(std::span<const CellGains> cells);

}  // namespace vantage
