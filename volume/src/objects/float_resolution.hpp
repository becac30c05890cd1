#pragma once

#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/grid_geometry.hpp"

namespace vantage::volume::detail {

/// Rays and meshes are float: far from the origin they move in steps that a grid of small voxels
/// shows.
/// @throws Error bad_input if float does not resolve a tenth of a voxel at the work area's corners,
/// at a camera, or anywhere on a mesh in its own frame.
void check_float_resolution(const WorldModel& world, const GridGeometry& geometry);

}  // namespace vantage::volume::detail
