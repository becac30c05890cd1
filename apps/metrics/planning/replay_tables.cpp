#include "metrics/planning/replay_tables.hpp"

#include <fmt/format.h>

#include "metrics/planning/planning_numbers.hpp"

namespace vantage {
namespace {

std::string m3_text(double m3) {
  return fmt::format("{:.5f}", m3);
}

std::string factor_text(double factor) {
  return fmt::format("×{:.2f}", factor);
}

TableRow pair_row(const ReplayPair& pair, std::size_t method) {
  const ReplayView &best = best_view(pair), &pick = pair.views[pair.picks[method]];
  const auto worth = worth_of(pair, method);
  return {{fmt::format("{}, {}", pair.frames[0], pair.frames[1]), m3_text(pair.shadow_m3),
           std::to_string(best.frame), m3_text(best.real_gain_m3), m3_text(mean_gain_m3(pair)),
           std::to_string(pick.frame), m3_text(pick.predicted_gain_m3),
           m3_text(pick.expected_gain_m3), m3_text(pick.real_gain_m3),
           worth ? percent_text(worth->share_of_best) : kNone,
           worth ? factor_text(worth->times_mean) : kNone,
           worth ? std::to_string(worth->rank) : kNone}};
}

ReportTable pairs_table(const ReplayEvaluation& evaluation, std::size_t method) {
  ReportTable table{fmt::format("Replay, {}: gains in m³", evaluation.methods[method]),
                    {{"pair", "", true},
                     {"shadow"},
                     {"frame", "best frame"},
                     {"real gain", "best frame"},
                     {"real gain", "mean frame"},
                     {"frame", "pick"},
                     {"predicted", "pick"},
                     {"expected", "pick"},
                     {"real gain", "pick"},
                     {"of best", "pick"},
                     {"mean", "pick"},
                     {"rank", "pick"}}};
  for (const ReplayPair& pair : evaluation.pairs) table.rows.push_back(pair_row(pair, method));
  return table;
}

TableRow means_row(const ReplayEvaluation& evaluation, std::size_t method) {
  const std::string& name = evaluation.methods[method];
  const auto means = replay_means(evaluation, method);
  if (!means) return {{name, kNone, kNone, kNone, kNone, kNone, kNone, kNone}};
  return {{name, m3_text(means->predicted_gain_m3), m3_text(means->expected_gain_m3),
           m3_text(means->real_gain_m3), percent_text(means->share_of_best),
           percent_text(means->min_share_of_best), factor_text(means->times_mean),
           fmt::format("{:.1f}", means->rank)}};
}

ReportTable means_table(const ReplayEvaluation& evaluation) {
  ReportTable table{fmt::format("Means over {} pairs of frames", evaluation.pairs.size()),
                    {{"method", "", true},
                     {"predicted", "gain, m³"},
                     {"expected", "gain, m³"},
                     {"real", "gain, m³"},
                     {"mean", "of the best frame's"},
                     {"least", "of the best frame's"},
                     {"of the mean frame's"},
                     {"rank"}}};
  for (std::size_t i = 0; i < evaluation.methods.size(); ++i) {
    table.rows.push_back(means_row(evaluation, i));
  }
  table.rows.push_back(
      {{"any frame", kNone, kNone, kNone, percent_text(blind_share_of_best(evaluation)), kNone,
        factor_text(1), kNone}});
  table.note =
      "Two frames of the recording are the cameras; a method picks one of the others by its pose "
      "alone. Real gain: shadow of the two frames that the picked frame's depth image turns free "
      "or occupied. Predicted: shadow in the pick's line of sight, by the voxel method; expected: "
      "how much of that it should reveal. Any frame: the mean over all frames.";
  if (const auto correlation = expected_rank_correlation(evaluation)) {
    table.note += fmt::format(
        " Rank correlation of expected and real gain over all frames: {:.3f}.", *correlation);
  }
  return table;
}

}  // namespace

std::vector<ReportTable> replay_tables(const ReplayEvaluation& evaluation) {
  std::vector<ReportTable> tables;
  for (std::size_t i = 0; i < evaluation.methods.size(); ++i) {
    tables.push_back(pairs_table(evaluation, i));
  }
  tables.push_back(means_table(evaluation));
  return tables;
}

}  // namespace vantage
