#pragma once

#include <filesystem>
#include <vector>

#include "plan/plan_input.hpp"
#include "vantage/planner/expected_gain.hpp"

namespace vantage {

/// A view of a plan, and what the plan predicts for it.
struct JudgedView {
  Pose T_world_cam;
  double promised_m3 = 0;
  std::optional<GainEstimate> expected = {};  ///< none in plans of older versions
};

/// A plan.json, with what it was made from, read again.
struct JudgedPlan {
  PlanInput input;
  std::vector<JudgedView> views;         ///< in their order
  std::vector<Pose> ranked;              ///< the best candidates
  std::vector<std::size_t> feasible;     ///< indices of the candidates that were not rejected
  std::optional<double> shadow_m3 = {};  ///< as the plan has it
};

/// @param workcell_file of the simulated dataset.
/// @throws Error bad_input for a file that is not a plan.json, one without a best view, and one
/// that was made from other files than this workcell's or the dataset's beside it; as
/// `load_plan_input`.
JudgedPlan read_judged_plan(const std::filesystem::path& workcell_file,
                            const std::filesystem::path& plan_file, const StopToken& stop);

}  // namespace vantage
