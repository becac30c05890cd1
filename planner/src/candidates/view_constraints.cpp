#include "vantage/planner/view_constraints.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

std::string text(const Eigen::Vector3d& v) {
  return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
}

void check_length(double length_m, const char* where) {
  if (std::isfinite(length_m) && length_m >= 0) return;
  throw bad_input(where, fmt::format("it is {} m; expected 0 or more", length_m));
}

}  // namespace

void Reach::check(std::string_view where) const {
  if (base_m.allFinite() && std::isfinite(max_m) && min_m >= 0 && min_m < max_m) return;
  throw bad_input(std::string(where),
                  fmt::format("the reach goes from {} to {} m around {}; expected finite numbers "
                              "with 0 <= min < max",
                              min_m, max_m, text(base_m)));
}

bool ReachMap::contains(const Eigen::Vector3d& p_world) const {
  const Eigen::Array3d index = ((p_world - origin_m) / cell_m).array().floor();
  if (!((index >= 0).all() && (index < size.array().cast<double>()).all())) return false;
  const auto at = [&](int axis) { return std::size_t(index[axis]); };
  return reachable[(at(0) * std::size_t(size.y()) + at(1)) * std::size_t(size.z()) + at(2)] != 0;
}

void ReachMap::check(std::string_view where) const {
  if (!(origin_m.allFinite() && std::isfinite(cell_m) && cell_m > 0)) {
    throw bad_input(std::string(where),
                    fmt::format("cells of {} m from {} on; expected finite numbers, and cells of "
                                "more than 0 m",
                                cell_m, text(origin_m)));
  }
  if (size.minCoeff() < 1 || size.cast<double>().prod() != double(reachable.size())) {
    throw bad_input(std::string(where),
                    fmt::format("{} values for {} x {} x {} cells; expected at least one cell "
                                "along each axis, and one value for each cell",
                                reachable.size(), size.x(), size.y(), size.z()));
  }
}

void ViewCone::check(std::string_view where) const {
  if (!(axis.allFinite() && axis.stableNorm() > 0)) {
    throw bad_input(std::string(where),
                    fmt::format("its axis is {}; expected a direction", text(axis)));
  }
  if (!(half_angle_rad > 0 && half_angle_rad <= std::numbers::pi)) {
    throw bad_input(std::string(where),
                    fmt::format("its half angle is {} rad; expected more than 0 and at most π",
                                half_angle_rad));
  }
}

void ViewConstraints::check() const {
  if (reach) reach->check("reach");
  if (reach_map) reach_map->check("reach map");
  if (view_cone) view_cone->check("view cone");
  check_length(clearance_m, "clearance");
  if (const SphereBody* sphere = std::get_if<SphereBody>(&body)) {
    check_length(sphere->radius_m, "radius of the camera's body");
  }
}

std::string_view to_text(InvalidReason reason) {
  switch (reason) {
    case InvalidReason::none:
      return "none";
    case InvalidReason::below_the_floor:
      return "below the floor";
    case InvalidReason::out_of_reach:
      return "out of reach";
    case InvalidReason::outside_the_view_cone:
      return "outside the view cone";
    case InvalidReason::inside_occupied_volume:
      return "inside occupied volume";
    case InvalidReason::inside_shadow:
      return "inside shadow";
    case InvalidReason::too_close_to_shadow:
      return "too close to shadow";
    case InvalidReason::too_close_to_occupied:
      return "too close to occupied volume";
  }
  return "unknown";
}

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
  if (lowest_m(limits, T_world_cam) < limits.clearance_m) return true;
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

bool too_close_to_shadow(const PlanningScene& scene, double near_m, const Eigen::Vector3d& centre) {
  const Scene& surfaces = scene.surfaces();
  if (!surfaces.closer_than(near_m, centre)) return false;  // as nearly always
  return surfaces.closer_than(near_m, centre, scene.shadow_object()) ||
         surfaces.closer_than(near_m, centre, scene.covered_object());
}

}  // namespace

ViewValidityChecker::ViewValidityChecker(const ViewConstraints& constraints, PlanningScene scene,
                                         const DepthRange& range)
    : constraints_(constraints), scene_(std::move(scene)), range_(range) {
  constraints_.check();
}

InvalidReason ViewValidityChecker::check(const Pose& T_world_cam) const {
  const Eigen::Vector3d& centre = T_world_cam.translation();
  if (centre.z() <= 0) return InvalidReason::below_the_floor;
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
  if (too_close_to_shadow(scene_, range_.near_m, centre)) return InvalidReason::too_close_to_shadow;
  const bool bumps = too_close(constraints_, scene_.occluders(), T_world_cam);
  return bumps ? InvalidReason::too_close_to_occupied : InvalidReason::none;
}

}  // namespace vantage
