#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "vantage/raycore/api.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/points.hpp"
#include "vantage/raycore/scene.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage {

/// The voxel method (thesis 7.2.5): a view is worth the volume of the shadow voxels whose centres
/// it would see past everything occupied. Shadow itself hides nothing.
///
/// Immutable and thread-safe; runs in the caller's task arena. Counts are integers, so that the
/// score is the same at any number of threads.
class VANTAGE_API VoxelScorer {
 public:
  /// `occluders`: everything occupied, see `occluder_scene`.
  VoxelScorer(const StateGrid& grid, std::shared_ptr<const Scene> occluders);

  /// The number of shadow voxels that `camera` sees; nothing if `stop` stopped the count.
  std::optional<std::uint64_t> count_revealed(const PinholeCamera& camera,
                                              const StopToken& stop = {}) const;

  /// 1 or 0 for every shadow voxel, in the order of `StateGrid::centres`.
  std::vector<std::uint8_t> revealed(const PinholeCamera& camera) const;

  std::size_t shadow_voxels() const noexcept { return shadow_.size(); }

 private:
  Points shadow_;
  std::shared_ptr<const Scene> occluders_;
};

}  // namespace vantage
