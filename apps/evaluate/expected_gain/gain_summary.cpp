#include "evaluate/expected_gain/gain_summary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "metrics/planning/planning_numbers.hpp"

namespace vantage {
namespace {

constexpr double kFew_m3 = 1e-12;

double ratio_of(const GainedView& view) {
  return view.gained_m3 / std::max(view.expected.expected_m3, kFew_m3);
}

double share_of_best(const CellGains& cell, const GainedView& view) {
  const double best = cell.best_gain_m3();
  return best > 0 ? view.gained_m3 / best : 1;
}

double median_of(std::vector<double> values) {
  const std::size_t middle = values.size() / 2;
  std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(middle));
  return values[middle];
}

GainSummary summary_of(std::span<const CellGains> cells, const std::string& method) {
  GainSummary sum{.method = method, .min_share_of_best = 1};
  std::vector<double> ratios;
  for (const CellGains& cell : cells) {
    for (const GainedView& view : cell.picks) {
      if (view.name != method) continue;
      ratios.push_back(ratio_of(view));
      sum.within += ratios.back() >= 0.7 && ratios.back() <= 1.4;
      sum.covered += view.gained_m3 >= view.expected.low_m3 - kFew_m3 &&
                     view.gained_m3 <= view.expected.high_m3 + kFew_m3;
      const double share = share_of_best(cell, view);
      sum.share_of_best += share;
      sum.min_share_of_best = std::min(sum.min_share_of_best, share);
    }
  }
  sum.cells = ratios.size();
  if (ratios.empty()) return sum;
  sum.median_ratio = median_of(ratios);
  for (double* value : {&sum.within, &sum.covered, &sum.share_of_best}) {
    *value /= double(sum.cells);
  }
  return sum;
}

TableRow row_of(const CellGains& cell, const GainedView& view) {
  return {{view.name, cm3_text(view.promised_m3), cm3_text(view.expected.expected_m3),
           cm3_text(view.expected.low_m3), cm3_text(view.expected.high_m3),
           cm3_text(view.gained_m3), fmt::format("{:.2f}", ratio_of(view)),
           cell.candidates.empty() ? kNone : percent_text(share_of_best(cell, view))}};
}

}  // namespace

std::vector<GainSummary> gain_summaries(std::span<const CellGains> cells) {
  std::vector<GainSummary> summaries;
  std::vector<std::string> methods;
  for (const CellGains& cell : cells) {
    for (const GainedView& view : cell.picks) {
      if (std::ranges::find(methods, view.name) == methods.end()) methods.push_back(view.name);
    }
  }
  for (const std::string& method : methods) summaries.push_back(summary_of(cells, method));
  return summaries;
}

std::vector<ReportTable> gain_tables(std::span<const CellGains> cells) {
  ReportTable all{"Expected and real gain of the picks, cm³",
                  {{"cell", "", true},
                   {"in sight"},
                   {"expected"},
                   {"from", "interval"},
                   {"to", "interval"},
                   {"gained"},
                   {"of expected"},
                   {"of the best"}}};
  for (const CellGains& cell : cells) {
    all.section(fmt::format("{}: {} cm³ of shadow, {} cm³ removed as false shadow", cell.name,
                            cm3_text(cell.shadow_m3), cm3_text(cell.false_shadow_m3)));
    for (const GainedView& view : cell.picks) all.rows.push_back(row_of(cell, view));
  }
  all.note =
      "Gained: shadow that turns free or occupied with the depth image that the movable camera "
      "measures there. Of the best: relative to the most that any feasible candidate gains.";
  ReportTable means{fmt::format("Over {} cells", cells.size()),
                    {{"method", "", true},
                     {"cells"},
                     {"median", "gained / expected"},
                     {"in 0.7 … 1.4", "gained / expected"},
                     {"in its interval"},
                     {"mean", "of the best"},
                     {"least", "of the best"}}};
  for (const GainSummary& sum : gain_summaries(cells)) {
    means.rows.push_back(
        {{sum.method, count_text(sum.cells), fmt::format("{:.3f}", sum.median_ratio),
          percent_text(sum.within), percent_text(sum.covered), percent_text(sum.share_of_best),
          percent_text(sum.min_share_of_best)}});
  }
  return {all, means};
}

}  // namespace vantage
