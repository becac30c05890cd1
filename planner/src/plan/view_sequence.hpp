#pragma once

#include "plan/planner_context.hpp"

namespace vantage::planner::detail {

/// Takes a view: adds it to the plan, and puts what it reveals into its grid.
/// @param left scores the shadow that is left in `plan.grid`.
void add_view(const VoxelScorer& left, const PinholeCamera& camera, const RankedView& view,
              Plan& plan);

/// Adds the views after the first one to a plan that has one.
void add_next_views(const WorldModel& world, const PlannerContext& context, Plan& plan,
                    const StopToken& stop);

}  // namespace vantage::planner::detail
