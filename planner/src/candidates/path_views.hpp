#pragma once

#include <vector>

#include "vantage/planner/view_candidates.hpp"

namespace vantage::detail {

/// Poses along a path: at its start, after every `step_m` of the way, and at its end. Positions are
/// interpolated linearly, rotations by the shortest way around.
/// @throws Error bad_input for an empty path, or one with more than `most` poses.
std::vector<Pose> poses_along(const std::vector<Pose>& path, double step_m, std::int64_t most);

}  // namespace vantage::detail
