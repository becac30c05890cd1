#pragma once

#include "vantage/planner/plan.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// The scene of `vantage demo`: a wall of 5 cm cubes on a board of 50 × 35 cm, as in the thesis'
/// data set "wall" (chapter 4), seen by one camera at its side.
WorldModel demo_world();

/// The board and 20 cm above it; the movable camera is like the given one.
PlanRequest demo_request();

}  // namespace vantage
