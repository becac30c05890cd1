#pragma once

#include "grid/openvdb.hpp"

#include <algorithm>
#include <string_view>

#include "grid/mask_blocks.hpp"
#include "vantage/raycore/triangle_mesh.hpp"
#include "vantage/volume/grid_geometry.hpp"

namespace vantage::volume::detail {

// Surfaces of sets of voxels, as the places where a field of numbers at the voxels' centres is 0:
// negative inside, as in level sets.

/// `-half` in the voxels, `half` elsewhere; active, and in leaves, up to `band` voxels from where
/// the two meet.
openvdb::FloatGrid::Ptr field_around(const openvdb::MaskTree& voxels, int band, float half);

/// A value that is on the side where its voxel is, by `margin` at least.
inline float on_side(float value, bool inside, float margin) {
  return inside ? std::min(value, -margin) : std::max(value, margin);
}

/// The field's surface in the world, looking outwards, two triangles to a quadrangle. Every voxel
/// next to one of the other side has to be active.
/// @param geometry the field's voxel (0, 0, 0) is the grid's first one.
TriangleMesh field_surface(const openvdb::FloatGrid& field, const GridGeometry& geometry,
                           std::string_view where);

}  // namespace vantage::volume::detail
