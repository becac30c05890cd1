#pragma once

#include <cstdint>
#include <vector>

#include "scoring/expected/unseen_model.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage::planner::detail {

/// How probable it is, for each of some voxels in sight, that the movable camera's measurement
/// turns it to free or occupied, in 255ths. Runs in the caller's task arena.
/// @param points the voxels' centres, all of them in the view.
std::vector<std::uint8_t> reading_probabilities(const UnseenModel& model, const PinholeCamera& view,
                                                PointsView points);

}  // namespace vantage::planner::detail
