#pragma once

#include <functional>
#include <memory>

#include "reference/for_each_voxel.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage::test {

/// What a test wants a voxel to be.
struct MadeVoxel {
  VoxelState state = VoxelState::free;
  bool measured = false;
  ShadowCause cause = ShadowCause::hidden;  ///< of shadow and revealed voxels
};

inline ShadowCause outside_if(bool outside) {
  return outside ? ShadowCause::outside : ShadowCause::hidden;
}

/// A grid whose voxels `what` decides, without any camera. Uniform blocks are tiles, of 8³ voxels
/// or larger, unless `tiles` is off.
std::shared_ptr<const StateGrid> make_grid(
    const GridGeometry& geometry, const std::function<MadeVoxel(const Eigen::Vector3i&)>& what,
    bool tiles = true);

using Inside = std::function<bool(const Eigen::Vector3i&)>;

/// Shadow inside, free outside.
std::shared_ptr<const StateGrid> shadow_where(const GridGeometry& geometry, const Inside& inside);

/// The voxels whose centres are in a ball; in voxels.
Inside ball(const Eigen::Vector3d& centre, double radius);

/// The voxels from `first` to before `end`.
Inside box(const Eigen::Vector3i& first, const Eigen::Vector3i& end);

/// A geometry of nx × ny × nz voxels of 1 cm that lies askew in the world.
GridGeometry geometry_of(int nx, int ny, int nz);

/// A random state for every voxel: mostly uniform blocks, with free, noisy and mixed ones between.
std::function<MadeVoxel(const Eigen::Vector3i&)> random_voxels(std::uint32_t seed);

}  // namespace vantage::test
