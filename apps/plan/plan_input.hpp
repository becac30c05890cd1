#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "plan/candidate_options.hpp"
#include "plan/plan_world.hpp"
#include "plan/report/plan_json.hpp"
#include "vantage/planner/plan.hpp"
#include "vantage/raycore/world_model.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

/// What a workcell asks of planning.
/// @param usual the movable camera's intrinsics, where the workcell does not say.
PlanRequest plan_request(const Workcell& workcell, const Intrinsics& usual);

/// What `vantage plan` was asked for. What is set here overrides the workcell file.
struct PlanOptions {
  std::filesystem::path dataset;
  std::filesystem::path workcell;      ///< empty: none
  std::vector<double> work_area = {};  ///< x0 y0 z0 x1 y1 z1; empty: from the workcell
  std::vector<int> images = {};        ///< empty: all of the dataset
  ObjectSource objects = {};
  std::vector<double> depth_range = {};  ///< near, far of all cameras; empty: from the workcell
  CandidateOptions candidates = {};
  /// Of the voxel size, the volume and the views, by the keys of their fields (options/).
  nlohmann::json given = nlohmann::json::object();
  bool refuse_unused = false;  ///< whether an option that does nothing is an error
};

/// All that planning needs.
struct PlanInput {
  WorldModel world;
  PlanRequest request;
  PlanRecord record;
  std::vector<std::string> warnings;
  MeshMethod mesh = {};  ///< the mesh method as it was asked for, whichever method the request has
};

/// Loads the dataset and the workcell, and finds the objects if they are not given. Runs in the
/// caller's task arena.
/// @throws Error bad_input as `load_plan_world` and `load_workcell` do, and for options that do not
/// make sense; UsageError for those that do nothing, if that is asked for.
PlanInput load_plan_input(const PlanOptions& options, const StopToken& stop = {});

}  // namespace vantage
