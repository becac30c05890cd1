#include "metrics/planning/replay_evaluation.hpp"

#include <algorithm>

namespace vantage {

const ReplayView& best_view(const ReplayPair& pair) {
  return *std::ranges::max_element(pair.views, {}, &ReplayView::real_gain_m3);
}

double mean_gain_m3(const ReplayPair& pair) {
  double sum = 0;
  for (const ReplayView& view : pair.views) sum += view.real_gain_m3;
  return sum / double(pair.views.size());
}

std::optional<PickWorth> worth_of(const ReplayPair& pair, std::size_t method) {
  const double best = best_view(pair).real_gain_m3;
  if (best <= 0) return std::nullopt;
  const double gain = pair.views[pair.picks[method]].real_gain_m3;
  const auto better = std::ranges::count_if(
      pair.views, [&](const ReplayView& view) { return view.real_gain_m3 > gain; });
  return PickWorth{gain / best, gain / mean_gain_m3(pair), std::size_t(better) + 1};
}

std::optional<ReplayMeans> replay_means(const ReplayEvaluation& evaluation, std::size_t method) {
  ReplayMeans sums{.min_share_of_best = 1};
  for (const ReplayPair& pair : evaluation.pairs) {
    const auto worth = worth_of(pair, method);
    if (!worth) continue;
    const ReplayView& pick = pair.views[pair.picks[method]];
    ++sums.pairs;
    sums.share_of_best += worth->share_of_best;
    sums.min_share_of_best = std::min(sums.min_share_of_best, worth->share_of_best);
    sums.times_mean += worth->times_mean;
    sums.rank += double(worth->rank);
    sums.predicted_gain_m3 += pick.predicted_gain_m3;
    sums.real_gain_m3 += pick.real_gain_m3;
  }
  if (sums.pairs == 0) return std::nullopt;
  for (double* sum : {&sums.share_of_best, &sums.times_mean, &sums.rank, &sums.predicted_gain_m3,
                      &sums.real_gain_m3}) {
    *sum /= double(sums.pairs);
  }
  return sums;
}

std::optional<double> blind_share_of_best(const ReplayEvaluation& evaluation) {
  double sum = 0;
  std::size_t pairs = 0;
  for (const ReplayPair& pair : evaluation.pairs) {
    const double best = best_view(pair).real_gain_m3;
    if (best <= 0) continue;
    sum += mean_gain_m3(pair) / best;
    ++pairs;
  }
  return pairs == 0 ? std::nullopt : std::optional(sum / double(pairs));
}

}  // namespace vantage
