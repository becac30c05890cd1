#pragma once

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/triangle_mesh.hpp"
#include "vantage/volume/state_grid.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

/// The faces between the voxels of a state and all others, world frame, outwards; coplanar
/// neighbours are merged into rectangles: triangles 2 r and 2 r + 1 are (a, b, c) and (a, c, d) of
/// the r-th rectangle's corners a, b, c, d. Thread-safe, as all functions here.
VANTAGE_API TriangleMesh voxel_faces(const StateGrid& grid, VoxelState state);

/// The same for the measured part of the occupied voxels.
VANTAGE_API TriangleMesh measured_faces(const StateGrid& grid);

/// The faces of the shadow in two parts; triangles as from `voxel_faces`.
struct ShadowSurface {
  TriangleMesh open;     ///< what a ray from outside may meet
  TriangleMesh covered;  ///< against solid voxels: a ray meets those first
};

/// The shadow's faces, where those voxels are solid that `occluder_scene` makes boxes of in this
/// mode: all that are occupied, or the measured ones.
VANTAGE_API ShadowSurface shadow_surface(const StateGrid& grid, OccluderMode mode);

}  // namespace vantage
