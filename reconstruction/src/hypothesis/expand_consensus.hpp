#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hypothesis/linear_system.hpp"

namespace vantage::reconstruction::detail {

/// Points that an object has to explain: three fit several poses exactly.
inline constexpr int kMinPoints = 4;

/// Measurements that are no coincidence.
inline constexpr std::size_t kReliableMeasurements = 3;

/// What counts as explained.
struct InlierThresholds {
  double inlier_px = 3;

  /// Hypotheses are weighed as if corners were no better than this: calibration, lens and the
  /// cameras' poses add to the corners' own noise.
  double min_sigma_px() const { return inlier_px / 6; }

  /// The largest chi-square of a correspondence that is explained: for points that of `inlier_px`
  /// in the root mean square (where the camera's pose has a covariance: the root of its square and
  /// that of three standard deviations), for poses the 99.9 % quantile with six degrees of freedom.
  double largest_chi_square(const Correspondence& correspondence) const;

  /// Whether the correspondence is explained by a pose at which this is its evidence.
  bool explains(const Correspondence& correspondence, const LinearSystem& system) const;
};

/// One way to explain some measurements: they show an object of this type at this pose.
struct PoseHypothesis {
  Pose T_world_object;
  std::vector<const Correspondence*> correspondences;  ///< of one type; ascending by measurement
  std::vector<LinearSystem> each;                      ///< of the correspondences
  LinearSystem sum;

  const TypePtr& type() const { return correspondences.front()->feature->type; }
  /// Points that it explains, those with large residuals less: what hypotheses compete by.
  double score(const InlierThresholds& thresholds) const;
  /// Whether `correspondence` may come in: one object explains a measurement once, and each of its
  /// features once in a view.
  bool has_room_for(const Correspondence& correspondence) const;
};

/// Fits a pose to the correspondences. Nothing if one of them is then not explained.
std::optional<PoseHypothesis> explain(std::vector<const Correspondence*> correspondences,
                                      const Pose& start, const InlierThresholds& thresholds);

/// Starts from the sample's pose and takes in, of `pool`, what fits, the likeliest first: as long
/// as the pose is vague, one correspondence at a time; then all that are where they are expected.
/// Nothing if the pose does not even explain the sample.
std::optional<PoseHypothesis> expand_consensus(std::vector<const Correspondence*> seed,
                                               const Pose& start,
                                               std::span<const Correspondence* const> pool,
                                               const InlierThresholds& thresholds);

}  // namespace vantage::reconstruction::detail
