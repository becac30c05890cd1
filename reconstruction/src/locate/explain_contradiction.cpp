#include "locate/explain_contradiction.hpp"

#include <algorithm>
#include <cmath>

#include "locate/board_readings.hpp"
#include "locate/golden_section.hpp"

namespace vantage::reconstruction::detail {
namespace {

/// How far a family was followed before anything is fitted.
struct Promise {
  const ReadingFamily* family = nullptr;
  double factor = 1;
  double score = 0;
};

/// By the best rough pose: cheap.
double rough_score(const BoardReading& reading, std::span<const BoardPair> pairs,
                   double inlier_px) {
  const std::vector<BoardPair> read = pairs_of(reading, pairs);
  const std::vector<Pose> poses = hypotheses(read, inlier_px);
  return poses.empty() ? 0 : agreement(read, poses.front(), kRough * inlier_px).score;
}

Promise promise_of(const ReadingFamily& family, std::span<const BoardPair> pairs,
                   double inlier_px) {
  Promise best{&family, 1, 0};
  for (const double factor : family.factors) {
    const auto reading = family.at(factor);
    if (!reading) continue;
    const double score = rough_score(*reading, pairs, inlier_px);
    if (score > best.score) best = {&family, factor, score};
  }
  return best;
}

std::optional<BoardFit> fit_of(const BoardReading& reading, std::span<const BoardPair> pairs,
                               double inlier_px) {
  const std::vector<BoardPair> read = pairs_of(reading, pairs);
  const auto fits = settled_fits(read, hypotheses(read, inlier_px), inlier_px);
  return fits.empty() ? std::nullopt : std::optional(fits.front());
}

/// The factor between its neighbours that leaves the least chi-square over the same pairs.
double refined_factor(const Promise& promise, const BoardFit& start,
                      std::span<const BoardPair> pairs) {
  constexpr int kSteps = 28;
  if (promise.family->factors.size() < 2) return promise.factor;
  const auto cost = [&](double log_factor) {
    const auto reading = promise.family->at(std::exp(log_factor));
    if (!reading) return HUGE_VAL;
    const auto fit = fit_pairs(pairs_of(*reading, pairs), start.pairs, start.T_cam_world(), 0);
    return fit ? fit->chi_square : HUGE_VAL;
  };
  return std::exp(least_by_golden_section(std::log(promise.factor / kFactorStep),
                                          std::log(promise.factor * kFactorStep), kSteps, cost));
}

std::optional<Explanation> followed(const Promise& promise, std::span<const BoardPair> pairs,
                                    double inlier_px) {
  auto reading = promise.family->at(promise.factor);
  if (!reading) return std::nullopt;
  // Off by half a step, many a marker is beyond the usual tolerance.
  auto fit = fit_of(*reading, pairs,
                    promise.family->factors.size() < 2 ? inlier_px : kRough / 2 * inlier_px);
  if (!fit) return std::nullopt;
  if (promise.family->factors.size() > 1) {
    reading = promise.family->at(refined_factor(promise, *fit, pairs));
    if (!reading) return std::nullopt;
    fit = fit_of(*reading, pairs, inlier_px);
    if (!fit) return std::nullopt;
  }
  const bool exact = promise.family->factors.size() < 2;
  return Explanation{reading->cause, fit->T_cam_world(), fit->pairs.size(), fit->fit.chi_square,
                     exact};
}

}  // namespace

std::optional<Explanation> explain_contradiction(const Lens& lens, std::span<const BoardPair> pairs,
                                                 std::span<const ObjectFeature> board,
                                                 std::size_t agreeing, std::size_t seen,
                                                 double inlier_px) {
  constexpr std::size_t kFollowed = 8;
  const std::vector<ReadingFamily> families = reading_families(lens, board);
  std::vector<Promise> promises;
  for (const ReadingFamily& family : families) {
    promises.push_back(promise_of(family, pairs, inlier_px));
  }
  std::ranges::stable_sort(promises, std::ranges::greater{}, &Promise::score);
  promises.resize(std::min(promises.size(), kFollowed));
  std::optional<Explanation> best;
  for (const Promise& promise : promises) {
    const auto found = followed(promise, pairs, inlier_px);
    if (!found || found->markers <= agreeing || 3 * found->markers < 2 * seen) continue;
    const bool better = !best || found->markers > best->markers ||
                        (found->markers == best->markers && found->chi_square < best->chi_square);
    if (better) best = found;
  }
  return best;
}

}  // namespace vantage::reconstruction::detail
