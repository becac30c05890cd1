#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "hypothesis/linear_system.hpp"

namespace vantage::detail {

/// Readings of one camera that are enough for a pose: a marker, a measured pose, or as many single
/// points of one type as it takes.
class Seed {
 public:
  explicit Seed(std::vector<const Reading*> readings) : readings_(std::move(readings)) {}

  const std::vector<const Reading*>& readings() const { return readings_; }

  /// Poses T_world_object in which they may be seen; the best first, both flips of a marker.
  /// Computed when first asked for.
  const std::vector<Pose>& poses();

 private:
  std::vector<const Reading*> readings_;
  std::optional<std::vector<Pose>> poses_ = {};
};

/// Everything that the same sightings may be.
struct SeedGroup {
  std::vector<std::size_t> numbers;  ///< of the sightings, ascending
  double size_px = 0;                ///< how large they are in the image: large ones come first
  std::vector<Seed> seeds;
};

/// All seeds of a component, the largest in the image first: their poses are the best ones.
/// @param readings ascending by sighting.
std::vector<SeedGroup> find_seeds(const std::vector<Reading>& readings);

}  // namespace vantage::detail
