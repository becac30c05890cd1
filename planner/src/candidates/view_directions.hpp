#pragma once

#include <Eigen/Core>
#include <vector>

#include "vantage/planner/view_candidates.hpp"

namespace vantage::planner::detail {

/// `count` unit vectors, spread evenly over the part of the sphere that is up to `polar_rad` from
/// +z (M. Deserno, 2004; see `half_sphere_directions`). From the zenith down.
std::vector<Eigen::Vector3d> directions_in_rings(int count, double polar_rad);

/// How many directions a fan has.
std::int64_t fan_size(const ViewFan& fan);

/// The poses of a fan at `eye`: the first looks at `target` (straight down if that is the eye
/// itself), then ring by ring, in each from the image's right over its bottom. All have the very
/// same translation, and the image's up as close to world +z as can be.
void add_fan(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, const ViewFan& fan,
             std::vector<ViewCandidate>& candidates);

/// Poses along a path: at its start, after every `step_m` of the way, and at its end. Positions are
/// interpolated linearly, rotations by the shortest way around.
/// @throws Error bad_input for an empty path, or one with more than `most` poses.
std::vector<Pose> poses_along(const std::vector<Pose>& path, double step_m, std::int64_t most);

}  // namespace vantage::planner::detail
