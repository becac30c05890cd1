#pragma once

#include <vector>

#include "plan/planner_context.hpp"

namespace vantage::planner::detail {

/// Polishes the first of `ranked` and sorts them again; among equals the lower candidate stays
/// first. All of them score at least as high as before, hence they stay ahead of the others.
///
/// @returns false if `stop` asked to stop before: then nothing is changed.
bool polish(const PlannerContext& context, std::vector<RankedView>& ranked, const StopToken& stop);

/// A candidate's servo iterations, and last, if it is one of the plan's polished views, that view;
/// each with its exact score, or nothing known where `stop` came first.
std::vector<ScoredStep> trace(const PlannerContext& context, const Plan& plan,
                              const ScoredCandidate& candidate, const StopToken& stop = {});

}  // namespace vantage::planner::detail
