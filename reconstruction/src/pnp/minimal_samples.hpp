#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "hypothesis/linear_system.hpp"

namespace vantage::reconstruction::detail {

/// Correspondences of one camera that are enough for a pose: a marker, a measured pose, or as many
/// single points of one type as it takes.
class MinimalSample {
 public:
  explicit MinimalSample(std::vector<const Correspondence*> correspondences)
      : correspondences_(std::move(correspondences)) {}

  const std::vector<const Correspondence*>& correspondences() const { return correspondences_; }

  /// Poses T_world_object in which they may be seen; the best first, both flips of a marker.
  /// Computed when first asked for.
  const std::vector<Pose>& poses();

 private:
  std::vector<const Correspondence*> correspondences_;
  std::optional<std::vector<Pose>> poses_ = {};
};

/// Everything that the same measurements may be.
struct SampleGroup {
  std::vector<std::size_t> numbers;  ///< of the measurements, ascending
  double size_px = 0;                ///< how large they are in the image: large ones come first
  std::vector<MinimalSample> samples;
};

/// All samples of a component, the largest in the image first: their poses are the best ones.
/// @param correspondences ascending by measurement.
std::vector<SampleGroup> find_minimal_samples(const std::vector<Correspondence>& correspondences);

}  // namespace vantage::reconstruction::detail
