#pragma once

#include "blocks.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/grid_geometry.hpp"

namespace vantage::detail {

/// Sets the voxels whose centres are inside an object.
///
/// A line through the centres of each row of voxels is cut by the object's surface; entering and
/// leaving are told apart by the faces' normals. Lines along x, y and z vote: a line that only
/// grazes an edge is outvoted by the other two. Runs in the caller's task arena.
void add_solid_voxels(const KnownObject& object, const GridGeometry& geometry, VoxelMask& solid);

}  // namespace vantage::detail
