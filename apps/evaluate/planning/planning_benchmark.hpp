#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "evaluate/planning/planning_cell.hpp"
#include "metrics/planning/planning_evaluation.hpp"
#include "metrics/planning/planning_page.hpp"
#include "vantage/planner/plan.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// A method under its name in tables.
struct NamedMethod {
  std::string name;
  Method method;
  ViewValue value =
      ViewValue::bound;  ///< of method voxel: the thesis' number, or the expected gain
};

/// "voxel", "expected" (the voxel method by expected gain), "mesh", "light", "shadow" (D6), or
/// "shadowD" and any power of the depth.
/// @throws Error bad_input for another name.
NamedMethod named_method(const std::string& name);

/// Several, in their order.
/// @throws Error bad_input for an unknown name, and for one that is given twice.
std::vector<NamedMethod> named_methods(const std::vector<std::string>& names);

/// What `vantage evaluate planning` was asked for.
struct PlanningBenchmarkOptions {
  std::vector<NamedMethod> methods;  ///< the first is `voxel`
  std::vector<std::string> sets;     ///< "full" first, "production"
  std::vector<double> radii_m{};     ///< of the full set's three half-spheres; the production set
                                     ///< has the first and the last. Empty: from the work area
  ServoOptions servo = {};
  PolishOptions polish = {};
  /// Fields of the voxel size and the volume (options/) that override the workcells'. With other
  /// occluders, anti-aliasing is as goes with them.
  nlohmann::json given = nlohmann::json::object();
  int repeat = 1;         ///< times that everything is timed
  int picture_width = 0;  ///< of the overviews; 0: none
};

/// Puts the methods and sets in order; `voxel` is always among them, because the others are
/// measured by it.
/// @throws Error bad_input for an unknown name, and for one that is given twice.
void choose(const std::vector<std::string>& methods, const std::vector<std::string>& sets,
            PlanningBenchmarkOptions& settings);

/// One scene with its pictures.
struct EvaluatedScene {
  SceneEvaluation scene;
  std::vector<PagePicture> pictures;  ///< their `scene` is not set
};

/// Classifies the cell, lets every method pick a view from every set, and compares the picks with
/// the voxel method's and with the ground truth. Runs in the caller's task arena; all but the run
/// times is the same at any number of threads. The result is meaningless if `stop` was cancelled.
/// @throws Error as `plan_next_view` does.
EvaluatedScene evaluate_planning(const PlanningCell& cell, const PlanningBenchmarkOptions& settings,
                                 const StopToken& stop);

}  // namespace vantage
