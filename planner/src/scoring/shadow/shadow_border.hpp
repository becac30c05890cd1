#pragma once

#include <optional>

#include "scoring/shadow/shadow_in_view.hpp"
#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/advanced/shadow_view.hpp"

namespace vantage::planner::detail {

/// The outermost pixels that show shadow, and points that they show, by rays from the image's
/// borders inwards: what lies between them need not be known.
///
/// @param faces of the scene.
/// @param expected changes no bounds; where it is right, what is behind it is not looked at.
ShadowObservation find_shadow_border(const PlanningScene& scene, const PinholeCamera& view,
                                     const ShadowFaces& faces,
                                     const std::optional<ExtremePoints>& expected);

}  // namespace vantage::planner::detail
