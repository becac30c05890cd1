#pragma once

#include <cstdint>
#include <vector>

#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/grid_geometry.hpp"
#include "vantage/volume/state_grid.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage::bench {

/// One depth image folded in voxel by voxel, as one would write it: a dense array, x slowest,
/// z fastest, one thread, every centre projected and compared, in float. There are no known
/// objects.
std::vector<VoxelState> carve(const DepthCamera& observer, const GridGeometry& geometry,
                              const VolumeOptions& options = {});

}  // namespace vantage::bench
