#pragma once

#include "vantage/planner/plan.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// From where to draw the overview of a plan that has a grid: from above, beside the suggested
/// camera, far enough away for a calm perspective. The focal length and the principal point are
/// such that the work area and all cameras fill the picture of `width` × 5/8 `width` pixels.
PinholeCamera overview_camera(const Plan& plan, const WorldModel& world, int width);

}  // namespace vantage
