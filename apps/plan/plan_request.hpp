#pragma once

#include "vantage/planner/plan.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

/// What a workcell asks of planning.
/// @param usual the movable camera's intrinsics, where the workcell does not say.
PlanRequest plan_request(const Workcell& workcell, const Intrinsics& usual);

}  // namespace vantage
