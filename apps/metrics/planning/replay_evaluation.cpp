#include "metrics/planning/replay_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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
    sums.expected_gain_m3 += pick.expected_gain_m3;
    sums.real_gain_m3 += pick.real_gain_m3;
  }
  if (sums.pairs == 0) return std::nullopt;
  for (double* sum : {&sums.share_of_best, &sums.times_mean, &sums.rank, &sums.predicted_gain_m3,
                      &sums.expected_gain_m3, &sums.real_gain_m3}) {
    *sum /= double(sums.pairs);
  }
  return sums;
}

namespace {

/// Ranks from 0 on; equals share the mean of their ranks.
std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last < order.size() && values[order[last]] == values[order[first]]) ++last;
    for (std::size_t i = first; i < last; ++i) ranks[order[i]] = 0.5 * double(first + last - 1);
    first = last;
  }
  return ranks;
}

std::optional<double> correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double n = double(a.size());
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
  const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a), bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  if (aa == 0 || bb == 0) return std::nullopt;
  return ab / std::sqrt(aa * bb);
}

}  // namespace

std::optional<double> expected_rank_correlation(const ReplayEvaluation& evaluation) {
  double sum = 0;
  std::size_t pairs = 0;
  for (const ReplayPair& pair : evaluation.pairs) {
    std::vector<double> expected, real;
    for (const ReplayView& view : pair.views) {
      expected.push_back(view.expected_gain_m3), real.push_back(view.real_gain_m3);
    }
    const auto one = correlation(ranks_of(expected), ranks_of(real));
    if (one) sum += *one, ++pairs;
  }
  return pairs == 0 ? std::nullopt : std::optional(sum / double(pairs));
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
