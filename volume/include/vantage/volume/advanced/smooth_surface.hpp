#pragma once

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/triangle_mesh.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage {

/// The surface of the voxels in a state without the voxels' steps, for people and for other
/// programs; world frame, closed (at the work area's border too), looking outwards.
///
/// The state's indicator function is smoothed (a Gaussian of about 1.6 voxels), but never so far
/// that a voxel changes sides: the centres of the state's voxels are inside the surface and all
/// others outside, so that what is one voxel thin stays. The surface is within a voxel's diagonal
/// of `voxel_faces`, which is what volumes are measured by.
///
/// Runs in the caller's task arena; the result is the same at any number of threads.
VANTAGE_API TriangleMesh smooth_surface(const StateGrid& grid, VoxelState state);

}  // namespace vantage
