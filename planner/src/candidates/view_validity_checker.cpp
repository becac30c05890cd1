#include "vantage/planner/advanced/view_validity_checker.hpp"

#include <cmath>
#include <utility>

namespace vantage {
namespace {

bool in_reach(const ViewConstraints& limits, const Eigen::Vector3d& centre) {
  if (limits.reach) {
    const double distance = (centre - limits.reach->base_m).norm();
    if (distance < limits.reach->min_m || distance > limits.reach->max_m) return false;
  }
  if (limits.reach_box && !limits.reach_box->contains(centre)) return false;
  return limits.reach_map == nullptr || limits.reach_map->contains(centre);
}

bool in_cone(const ViewCone& cone, const Eigen::Vector3d& forward) {
  // A view along the cone's very border is allowed, however it is rounded.
  return forward.dot(cone.axis.stableNormalized()) >= std::cos(cone.half_angle_rad) - 1e-12;
}

/// How high the lowest point of the camera's body is.
double lowest_m(const ViewConstraints& limits, const Pose& T_world_cam) {
  if (const BoxBody* body = std::get_if<BoxBody>(&limits.body)) {
    const double reach_m = T_world_cam.rotation().row(2).cwiseAbs() * (0.5 * body->box.size());
    return (T_world_cam * body->box.centre()).z() - reach_m;
  }
  const SphereBody* sphere = std::get_if<SphereBody>(&limits.body);
  return T_world_cam.translation().z() - (sphere == nullptr ? 0 : sphere->radius_m);
}

/// Whether the camera's body is closer to a surface or the floor than the clearance, or has one
/// inside, or is inside itself.
bool too_close(const ViewConstraints& limits, const Scene& occupied, const Pose& T_world_cam) {
  if (limits.floor_z_m && lowest_m(limits, T_world_cam) < *limits.floor_z_m + limits.clearance_m) {
    return true;
  }
  if (const BoxBody* body = std::get_if<BoxBody>(&limits.body)) {
    // The camera's centre is known to be outside of everything; a box beside it may not be.
    return occupied.closer_than(limits.clearance_m, body->box, T_world_cam) ||
           (!body->box.contains(Eigen::Vector3d::Zero()) &&
            occupied.encloses(T_world_cam * body->box.centre()));
  }
  const SphereBody* sphere = std::get_if<SphereBody>(&limits.body);
  const double distance_m = limits.clearance_m + (sphere == nullptr ? 0 : sphere->radius_m);
  return distance_m > 0 && occupied.closer_than(distance_m, T_world_cam.translation());
}

/// Whether faces of the shadow are closer to something than a distance.
template <class... Something>
bool shadow_closer_than(const PlanningScene& scene, double distance_m,
                        const Something&... something) {
  const Scene& surfaces = scene.surfaces();
  if (!surfaces.closer_than(distance_m, something...)) return false;  // as nearly always
  return surfaces.closer_than(distance_m, something..., scene.shadow_object()) ||
         surfaces.closer_than(distance_m, something..., scene.covered_object());
}

/// How far the body's farthest point is from the camera's centre.
double extent_m(const CameraBody& body) {
  if (const BoxBody* box = std::get_if<BoxBody>(&body)) {
    return box->box.min().cwiseAbs().cwiseMax(box->box.max().cwiseAbs()).norm();
  }
  const SphereBody* sphere = std::get_if<SphereBody>(&body);
  return sphere == nullptr ? 0 : sphere->radius_m;
}

bool in_shadow(const StateGrid& grid, const Eigen::Vector3d& p_world) {
  const auto voxel = grid.geometry().voxel_at(p_world);
  return voxel && grid.at(*voxel) == VoxelState::shadow;
}

/// Whether the camera's body overlaps the shadow.
/// @param near_m within this distance of the camera's centre there is no shadow.
bool body_in_unseen(const CameraBody& body, const PlanningScene& scene, double near_m,
                    const Pose& T_world_cam) {
  if (extent_m(body) <= near_m) return false;
  if (const BoxBody* box = std::get_if<BoxBody>(&body)) {
    // A box beside the camera may be inside as a whole, away from all faces.
    return shadow_closer_than(scene, 0, box->box, T_world_cam) ||
           in_shadow(scene.grid(), T_world_cam * box->box.centre());
  }
  return shadow_closer_than(scene, extent_m(body), T_world_cam.translation());
}

}  // namespace

ViewValidityChecker::ViewValidityChecker(const ViewConstraints& constraints, PlanningScene scene,
                                         const DepthRange& range)
    : constraints_(constraints), scene_(std::move(scene)), range_(range) {
  constraints_.check();
}

InvalidReason ViewValidityChecker::built_in(const Pose& T_world_cam) const {
  const Eigen::Vector3d& centre = T_world_cam.translation();
  if (constraints_.floor_z_m && centre.z() <= *constraints_.floor_z_m) {
    return InvalidReason::below_the_floor;
  }
  if (!in_reach(constraints_, centre)) return InvalidReason::out_of_reach;
  if (constraints_.view_cone && !in_cone(*constraints_.view_cone, T_world_cam.rotation().col(2))) {
    return InvalidReason::outside_the_view_cone;
  }
  const auto voxel = scene_.grid().geometry().voxel_at(centre);
  const VoxelState state = voxel ? scene_.grid().at(*voxel) : VoxelState::free;
  // Structures reach beyond the grid, and may be thinner than its voxels.
  if (state == VoxelState::occupied || scene_.occluders().encloses(centre)) {
    return InvalidReason::inside_occupied_volume;
  }
  if (state == VoxelState::shadow) return InvalidReason::inside_shadow;
  if (shadow_closer_than(scene_, range_.near_m, centre)) return InvalidReason::too_close_to_shadow;
  if (body_in_unseen(constraints_.body, scene_, range_.near_m, T_world_cam)) {
    return InvalidReason::body_in_unseen;
  }
  const bool bumps = too_close(constraints_, scene_.occluders(), T_world_cam);
  return bumps ? InvalidReason::too_close_to_occupied : InvalidReason::none;
}

ViewValidity ViewValidityChecker::examine(const Pose& T_world_cam) const {
  const InvalidReason reason = built_in(T_world_cam);
  if (reason != InvalidReason::none) return {reason};
  for (const ViewCheck& check : constraints_.checks) {
    if (std::optional<std::string> why = check(T_world_cam)) {
      return {InvalidReason::rejected_by_check, std::move(*why)};
    }
  }
  return {};
}

}  // namespace vantage
