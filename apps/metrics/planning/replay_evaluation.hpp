#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vantage {

/// A recorded frame as the view to take after two others.
struct ReplayView {
  int frame = 0;                    ///< its image's id
  double predicted_gain_m3 = 0;     ///< the shadow in its line of sight, by the voxel method
  double real_gain_m3 = 0;          ///< the shadow that its depth image turns free or occupied
  std::vector<double> scores = {};  ///< by every method, in that method's unit
  double expected_gain_m3 = 0;      ///< how much of that it is expected to reveal
};

/// Two frames as the cameras, and all others as the candidates.
struct ReplayPair {
  std::array<int, 2> frames = {};       ///< ids of their images
  double shadow_m3 = 0;                 ///< that the two leave
  std::vector<ReplayView> views = {};   ///< ascending by frame; never empty
  std::vector<std::size_t> picks = {};  ///< by every method: index into `views`
};

/// How methods chose among the frames of a recording.
struct ReplayEvaluation {
  std::vector<std::string> methods;
  std::vector<ReplayPair> pairs;
};

/// The view that really revealed most; the first of them.
const ReplayView& best_view(const ReplayPair& pair);

/// What the views really revealed on average, m³.
double mean_gain_m3(const ReplayPair& pair);

/// How good a pick turned out to be.
struct PickWorth {
  double share_of_best = 0;  ///< its real gain / the best view's
  double times_mean = 0;     ///< its real gain / the views' mean
  std::size_t rank = 1;      ///< 1 + how many views revealed more
};

/// Of method `method`'s pick; nothing where no view revealed anything.
std::optional<PickWorth> worth_of(const ReplayPair& pair, std::size_t method);

/// Means over the pairs in which some view revealed something.
struct ReplayMeans {
  std::size_t pairs = 0;
  double share_of_best = 0, min_share_of_best = 0, times_mean = 0, rank = 0;
  double predicted_gain_m3 = 0, expected_gain_m3 = 0, real_gain_m3 = 0;
};

/// Of one method; nothing where no view of any pair revealed anything.
std::optional<ReplayMeans> replay_means(const ReplayEvaluation& evaluation, std::size_t method);

/// How well the expected gains order the frames: Spearman's rank correlation with the real gains,
/// the mean over the pairs. Nothing without a pair whose frames differ.
std::optional<double> expected_rank_correlation(const ReplayEvaluation& evaluation);

/// What a random choice among the views would give: the mean of the views' mean gain / the best
/// view's.
std::optional<double> blind_share_of_best(const ReplayEvaluation& evaluation);

}  // namespace vantage
