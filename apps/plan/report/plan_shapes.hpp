#pragma once

#include <Eigen/Core>
#include <vector>

#include "vantage/planner/plan.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/mesh_io.hpp"
#include "vantage/raycore/triangle_mesh.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// Things to show in pictures and models; world frame, metres.

/// Several meshes as one.
TriangleMesh joined(const std::vector<TriangleMesh>& meshes);

/// A rod with round ends left open, from a to b.
TriangleMesh rod(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius_m);

/// The twelve edges of a box as rods.
TriangleMesh box_edges(const Box& box, double radius_m);

/// The corners of a camera's image at a depth: the far end of its frustum.
std::vector<Eigen::Vector3d> frustum_corners(const PinholeCamera& camera, double depth_m);

/// A camera: its body of a depth camera's proportions, and its frustum up to a depth as rods.
TriangleMesh camera_shape(const PinholeCamera& camera, double body_width_m, double frustum_m,
                          double rod_radius_m);

/// What there is to show of a plan that has a grid, as coloured meshes in the world frame.

/// Half the diagonal of the work area: sizes of what is drawn follow it.
double scale_of(const Plan& plan);

/// Where the floor is drawn: below the work area, or at z = 0 if that is lower.
double floor_height(const Plan& plan);

/// The movable camera at the views to take, in their order; none if there is none.
std::vector<PinholeCamera> suggested_cameras(const Plan& plan);

/// Occupied voxels green, shadow red, revealed cyan; the last with an opacity below 1.
std::vector<ColoredMesh> voxel_meshes(const StateGrid& grid);

/// Where the suggested cameras' bodies are, in their order: for their numbers.
std::vector<Eigen::Vector3d> suggested_bodies(const Plan& plan);

/// What is known to stand clearly outside the work area, with a part at least: static structures
/// and objects, grey, with an opacity below 1. What is below the floor is left out, and what
/// surrounds the work area and all cameras, such as a room, of which one would see the inside.
std::vector<ColoredMesh> structure_meshes(const Plan& plan, const WorldModel& world);

/// Colours of what is drawn, sRGB, 0 to 1.
struct PlanColors {
  Eigen::Vector3f occupied, shadow, revealed, given_camera, suggested_camera, structure;
};
PlanColors plan_colors();

/// The work area's edges; the given cameras grey, the suggested ones red, with their frusta.
std::vector<ColoredMesh> camera_meshes(const Plan& plan, const WorldModel& world);

}  // namespace vantage
