#pragma once

#include <vector>

#include "vantage/planner/plan.hpp"
#include "vantage/raycore/mesh_io.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// What there is to show of a plan that has a grid, as coloured meshes in the world frame.

/// Half the diagonal of the work area: sizes of what is drawn follow it.
double scale_of(const Plan& plan);

/// The movable camera at the views to take, in their order; none if there is none.
std::vector<PinholeCamera> suggested_cameras(const Plan& plan);

/// Occupied voxels green, shadow red, revealed cyan; the last with an opacity below 1.
std::vector<ColoredMesh> voxel_meshes(const StateGrid& grid);

/// The work area's edges; the given cameras grey, the suggested ones red, with their frusta.
std::vector<ColoredMesh> camera_meshes(const Plan& plan, const WorldModel& world);

}  // namespace vantage
