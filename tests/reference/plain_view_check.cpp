#include "reference/plain_view_check.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/for_each_voxel.hpp"
#include "reference/plain_nearness.hpp"
#include "vantage/volume/advanced/voxel_surface.hpp"

namespace vantage::test {
namespace {

using Eigen::Vector3d;

constexpr double kMargin = 1e-5;

/// What a number says about being below a limit; it notes when that is a close call.
struct ReconstructionEvaluator {
  bool close_call = false;

  bool below(double value, double limit) {
    close_call |= std::abs(value - limit) < kMargin;
    return value < limit;
  }
};

bool in_box(const Box& box, const Vector3d& p, ReconstructionEvaluator& judge) {
  bool inside = true;
  for (int axis = 0; axis < 3; ++axis) {
    inside &= !judge.below(p[axis], box.min()[axis]) && judge.below(p[axis], box.max()[axis]);
  }
  return inside;
}

/// Cell by cell, whether it is the one that the point is in.
bool in_map(const ReachMap& map, const Vector3d& p, ReconstructionEvaluator& judge) {
  std::size_t next = 0;
  for (int i = 0; i < map.size.x(); ++i) {
    for (int j = 0; j < map.size.y(); ++j) {
      for (int k = 0; k < map.size.z(); ++k) {
        const Vector3d min = map.origin_m + map.cell_m * Vector3d(i, j, k);
        const Box cell(min, min + Vector3d::Constant(map.cell_m));
        if (in_box(cell, p, judge)) return map.reachable[next] != 0;
        ++next;
      }
    }
  }
  return false;
}

bool in_reach(const ViewConstraints& limits, const Vector3d& centre,
              ReconstructionEvaluator& judge) {
  bool reached = true;
  if (limits.reach) {
    const double distance = (centre - limits.reach->base_m).norm();
    reached &= !judge.below(distance, limits.reach->min_m);
    reached &= judge.below(distance, limits.reach->max_m);
  }
  if (limits.reach_box) reached &= in_box(*limits.reach_box, centre, judge);
  if (limits.reach_map) reached &= in_map(*limits.reach_map, centre, judge);
  return reached;
}

ReferenceScene occupied_surfaces(const WorldModel& world, const StateGrid& grid) {
  ReferenceScene scene;
  ObjectId next = 0;
  for (const KnownObject& object : world.objects) {
    scene.add(*object.mesh, object.T_world_object, next++);
  }
  for (const KnownObject& object : world.static_structures) {
    scene.add(*object.mesh, object.T_world_object, next++);
  }
  scene.add(measured_faces(grid), {}, next);
  return scene;
}

/// The height of the body's lowest corner or point.
double lowest_m(const ViewConstraints& limits, const Pose& pose) {
  double lowest = pose.translation().z();
  if (const auto* body = std::get_if<SphereBody>(&limits.body)) lowest -= body->radius_m;
  if (const auto* body = std::get_if<BoxBody>(&limits.body)) {
    lowest = std::numeric_limits<double>::infinity();
    const Vector3d &low = body->box.min(), &high = body->box.max();
    for (const double x : {low.x(), high.x()}) {
      for (const double y : {low.y(), high.y()}) {
        for (const double z : {low.z(), high.z()}) {
          lowest = std::min(lowest, (pose * Vector3d(x, y, z)).z());
        }
      }
    }
  }
  return lowest;
}

bool body_bumps(const ViewConstraints& limits, const ReferenceScene& occupied, const Pose& pose,
                ReconstructionEvaluator& judge) {
  if (limits.floor_z_m &&
      judge.below(lowest_m(limits, pose) - *limits.floor_z_m, limits.clearance_m)) {
    return true;
  }
  if (const auto* body = std::get_if<BoxBody>(&limits.body)) {
    const double distance = nearest_surface(occupied, body->box, pose);
    if (distance == 0 || surrounded(occupied, pose * body->box.centre())) return true;
    return judge.below(distance, limits.clearance_m);
  }
  double allowed = limits.clearance_m;
  if (const auto* body = std::get_if<SphereBody>(&limits.body)) allowed += body->radius_m;
  return allowed > 0 && judge.below(nearest_surface(occupied, pose.translation()), allowed);
}

/// How far a box is from another in its own frame along the direction in which they are farthest
/// apart (S. Gottschalk, M. Lin, D. Manocha, 1996); negative if they overlap.
double separation(const Box& body, const Pose& T_world_body, const Box& box) {
  const Eigen::Matrix3d axes = T_world_body.rotation();
  std::vector<Vector3d> directions;
  for (int i = 0; i < 3; ++i) {
    directions.push_back(Vector3d::Unit(i));
    directions.push_back(axes.col(i));
    for (int j = 0; j < 3; ++j) directions.push_back(Vector3d::Unit(i).cross(axes.col(j)));
  }
  const Vector3d between = T_world_body * body.centre() - box.centre();
  double most = -std::numeric_limits<double>::infinity();
  for (const Vector3d& direction : directions) {
    if (direction.norm() < 1e-9) continue;  // of parallel edges
    const Vector3d d = direction.normalized();
    const double halves = (axes.transpose() * d).cwiseAbs().dot(0.5 * body.size()) +
                          d.cwiseAbs().dot(0.5 * box.size());
    most = std::max(most, std::abs(between.dot(d)) - halves);
  }
  return most;
}

/// Voxel by voxel, whether the body overlaps one of the shadow.
bool body_in_shadow(const ViewConstraints& limits, const StateGrid& grid, const Pose& pose,
                    ReconstructionEvaluator& judge) {
  double least = std::numeric_limits<double>::infinity();
  for_each_voxel(grid.geometry(), [&](const Eigen::Vector3i& voxel) {
    if (grid.at(voxel) != VoxelState::shadow) return;
    const Vector3d half = Vector3d::Constant(0.5 * grid.geometry().voxel_size_m());
    const Vector3d centre = grid.geometry().centre(voxel);
    const Box box(centre - half, centre + half);
    if (const auto* body = std::get_if<BoxBody>(&limits.body)) {
      least = std::min(least, separation(body->box, pose, box));
    }
    if (const auto* body = std::get_if<SphereBody>(&limits.body)) {
      const Vector3d nearest = pose.translation().cwiseMax(box.min()).cwiseMin(box.max());
      least = std::min(least, (nearest - pose.translation()).norm() - body->radius_m);
    }
  });
  return judge.below(least, 0);
}

InvalidReason first_reason(const WorldModel& world, const StateGrid& grid,
                           const ViewConstraints& limits, const DepthRange& range, const Pose& pose,
                           ReconstructionEvaluator& judge) {
  const Vector3d centre = pose.translation();
  if (judge.below(centre.z(), 0)) return InvalidReason::below_the_floor;
  if (!in_reach(limits, centre, judge)) return InvalidReason::out_of_reach;
  if (limits.view_cone) {
    const Vector3d forward = pose.rotation().col(2), &axis = limits.view_cone->axis;
    const double angle = std::atan2(forward.cross(axis).norm(), forward.dot(axis));
    if (!judge.below(angle, limits.view_cone->half_angle_rad)) {
      return InvalidReason::outside_the_view_cone;
    }
  }
  VoxelState state = VoxelState::free;
  if (const auto voxel = grid.geometry().voxel_at(centre)) state = grid.at(*voxel);
  const ReferenceScene occupied = occupied_surfaces(world, grid);
  judge.close_call |= nearest_surface(occupied, centre) < kMargin;
  if (state == VoxelState::occupied || surrounded(occupied, centre)) {
    return InvalidReason::inside_occupied_volume;
  }
  if (state == VoxelState::shadow) return InvalidReason::inside_shadow;
  ReferenceScene shadow;
  shadow.add(voxel_faces(grid, VoxelState::shadow), {}, 0);
  if (judge.below(nearest_surface(shadow, centre), range.near_m)) {
    return InvalidReason::too_close_to_shadow;
  }
  if (body_in_shadow(limits, grid, pose, judge)) return InvalidReason::body_in_unseen;
  return body_bumps(limits, occupied, pose, judge) ? InvalidReason::too_close_to_occupied
                                                   : InvalidReason::none;
}

}  // namespace

std::optional<InvalidReason> plain_view_check(const WorldModel& world, const StateGrid& grid,
                                              const ViewConstraints& limits,
                                              const DepthRange& range, const Pose& T_world_cam) {
  ReconstructionEvaluator judge;
  const InvalidReason reason = first_reason(world, grid, limits, range, T_world_cam, judge);
  if (judge.close_call) return std::nullopt;
  return reason;
}

}  // namespace vantage::test
