#pragma once

#include <cstdint>
#include <utility>

#include "objects/block_buffer.hpp"
#include "objects/mesh_instance.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage::volume::detail {

/// Sets the voxels of a mesh that is not closed whose generalized winding number is above one half.
/// @param mesh  the triangles of its solid surface, in the grid's frame.
/// @returns `wound` and `ambiguous` of `ObjectVoxels`; less if `stop` asks to stop.
std::pair<std::uint64_t, std::uint64_t> fill_wound(const PlacedMesh& placed,
                                                   const PlacedTriangles& mesh,
                                                   const CellRange& voxels, double voxel_size_m,
                                                   const StopToken& stop, BlockBuffer& buffer);

}  // namespace vantage::volume::detail
