#pragma once

#include <optional>

#include "shadow_in_view.hpp"
#include "vantage/planner/planning_scene.hpp"
#include "vantage/planner/servo_refiner.hpp"

namespace vantage::detail {

/// The outermost pixels that show shadow, by rays from the image's borders inwards: what lies
/// between them need not be known.
std::optional<ShadowBounds> find_shadow_bounds(const PlanningScene& scene,
                                               const PinholeCamera& view,
                                               const ShadowOutline& shadow);

}  // namespace vantage::detail
