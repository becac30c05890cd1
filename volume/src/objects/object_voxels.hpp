#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/block_set.hpp"
#include "objects/mesh_instance.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/volume/grid_geometry.hpp"

namespace vantage::volume::detail {

/// The voxels that one object fills, block by block; only blocks that have some, in ascending
/// order.
struct ObjectVoxels {
  struct Block {
    std::size_t block;
    BlockBits bits;
  };
  std::vector<Block> blocks;

  /// Of an open mesh: the voxels whose winding number is that of an inside or between, 0.25 or
  /// more, and those of them where it is less than 0.75.
  std::uint64_t wound = 0, ambiguous = 0;
};

/// The voxels whose centres are inside a mesh. Of a mesh that is not closed these are the voxels
/// whose generalized winding number is above one half, by more than its rounding, and those that
/// its sheets touch.
///
/// Of a closed mesh:
/// A line along z through the centres of each column of voxels is cut by the surface. Whether a
/// triangle meets a line is decided exactly, and a line through an edge or a vertex is treated as
/// if it passed infinitesimally beside it, always on the same side: so it meets exactly one of the
/// triangles that meet there, and no column ever leaks.
/// If `stop` asks to stop, what is there is incomplete.
ObjectVoxels object_voxels(const PlacedMesh& placed, const BlockLayout& layout, double voxel_size_m,
                           const StopToken& stop);

/// Where a mesh's surface may pass through, one bit for each octant of a block; only blocks that
/// have some, in ascending order.
struct SurfaceOctants {
  struct Block {
    std::size_t block;
    std::uint8_t octants;
  };
  std::vector<Block> blocks;
};

/// Never misses one.
SurfaceOctants surface_octants(const PlacedTriangles& mesh, const BlockLayout& layout,
                               double voxel_size_m);

}  // namespace vantage::volume::detail
