#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hypothesis/linear_system.hpp"

namespace vantage::detail {

/// Points that an object has to explain: three fit several poses exactly.
inline constexpr int kFewestPoints = 4;

/// Sightings that are no coincidence.
inline constexpr std::size_t kFirm = 3;

/// What counts as explained.
struct Bounds {
  double inlier_px = 3;

  /// Hypotheses are weighed as if corners were no better than this: calibration, lens and the
  /// cameras' poses add to the corners' own noise.
  double least_sigma_px() const { return inlier_px / 6; }

  /// The largest chi-square of a reading that is explained: for points that of `inlier_px` in the
  /// root mean square (where the camera's pose has a covariance: the root of its square and that of
  /// three standard deviations), for poses the 99.9 % quantile with six degrees of freedom.
  double largest_chi_square(const Reading& reading) const;

  /// Whether the reading is explained by a pose at which this is its evidence.
  bool explains(const Reading& reading, const Evidence& evidence) const;
};

/// One way to explain some sightings: they show an object of this type at this pose.
struct Explanation {
  Pose T_world_object;
  std::vector<const Reading*> readings;  ///< of one type; ascending by sighting
  std::vector<Evidence> each;            ///< of the readings
  Evidence sum;

  const TypePtr& type() const { return readings.front()->feature->type; }
  /// Points that it explains, those with large residuals less: what hypotheses compete by.
  double score(const Bounds& bounds) const;
  /// Whether `reading` may come in: one object explains a sighting once, and each of its features
  /// once in a view.
  bool has_room_for(const Reading& reading) const;
};

/// Fits a pose to the readings. Nothing if one of them is then not explained.
std::optional<Explanation> explain(std::vector<const Reading*> readings, const Pose& start,
                                   const Bounds& bounds);

/// Starts from the seed's pose and takes in, of `pool`, what fits, the likeliest first: as long as
/// the pose is vague, one reading at a time; then all that are where they are expected.
/// Nothing if the pose does not even explain the seed.
std::optional<Explanation> grow(std::vector<const Reading*> seed, const Pose& start,
                                std::span<const Reading* const> pool, const Bounds& bounds);

}  // namespace vantage::detail
