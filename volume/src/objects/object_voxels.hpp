#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "grid/block_set.hpp"
#include "objects/mesh_instance.hpp"
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
};

/// The voxels whose centres are inside a closed mesh, or which an open mesh's surface touches.
///
/// A line along z through the centres of each column of voxels is cut by the surface. Whether a
/// triangle meets a line is decided exactly, and a line through an edge or a vertex is treated as
/// if it passed infinitesimally beside it, always on the same side: so it meets exactly one of the
/// triangles that meet there, and no column ever leaks.
ObjectVoxels object_voxels(const PlacedTriangles& mesh, Closure closure, const BlockLayout& layout,
                           double voxel_size_m);

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
