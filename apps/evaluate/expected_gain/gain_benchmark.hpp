#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "evaluate/planning/planning_cell.hpp"
#include "vantage/planner/plan.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// What was predicted for a view, and what it really gained.
struct GainedView {
  std::string name;        ///< the method that picked it, or the candidate's number
  double promised_m3 = 0;  ///< the upper bound
  GainEstimate expected;
  double gained_m3 = 0;
};

/// One cell: what the methods picked, and all candidates if they were measured.
struct CellGains {
  std::string name;
  double shadow_m3 = 0;
  double false_shadow_m3 = 0;
  std::vector<GainedView> picks = {};
  std::vector<GainedView> candidates = {};

  double best_gain_m3() const;
};

/// A way to pick a view.
struct GainMethod {
  std::string name;
  Method method;
  ViewValue value;
};

/// "expected", "bound", "mesh", "shadow", "shadowD3", "light" …
GainMethod gain_method(const std::string& name);

/// Plans by every method, and measures what the picks and all feasible candidates gain.
CellGains evaluate_expected_gain(const PlanningCell& cell, const std::vector<GainMethod>& methods,
                                 bool candidates, const StopToken& stop);

}  // namespace vantage
