#pragma once

#include <Eigen/Core>
#include <vector>

#include "vantage/planner/view_candidates.hpp"

namespace vantage::detail {

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

}  // namespace vantage::detail
