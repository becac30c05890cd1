#pragma once

#include "grid/openvdb.hpp"

#include "vantage/raycore/triangle_mesh.hpp"
#include "vantage/volume/advanced/voxel_surface.hpp"
#include "vantage/volume/grid_geometry.hpp"

namespace vantage::volume::detail {

/// The faces between the active voxels, in the grid or next to it, and all others, outwards, world
/// frame; neighbours in a plane are merged into rectangles, row by row, then rows of equal extent.
TriangleMesh voxel_faces(const openvdb::MaskTree& voxels, const GridGeometry& geometry);

/// The same in two parts, each merged by itself: the faces against voxels of `covering`, and the
/// others.
ShadowSurface split_voxel_faces(const openvdb::MaskTree& voxels, const openvdb::MaskTree& covering,
                                const GridGeometry& geometry);

}  // namespace vantage::volume::detail
