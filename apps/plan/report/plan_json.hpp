#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "vantage/planner/plan.hpp"
#include "vantage/volume/advanced/shadow_regions.hpp"

namespace vantage {

// What plan.json says of the work area, all of it as the given cameras left it: what the best view
// would reveal is shadow still. Null (no warnings) if the plan was stopped before that was known.

nlohmann::ordered_json volumes_json(const Plan& plan);
nlohmann::ordered_json anti_alias_json(const Plan& plan);
nlohmann::ordered_json conflicts_json(const Plan& plan);
nlohmann::ordered_json regions_json(const ShadowRegions* regions);
/// @param of_input what was noticed while the inputs were read.
nlohmann::ordered_json warnings_json(const Plan& plan, const std::vector<std::string>& of_input);

/// What plan.json says beside the plan itself.
struct PlanRecord {
  double load_s = 0;
  double total_s = 0;
  std::vector<std::filesystem::path> inputs;  ///< every file that was read
  nlohmann::ordered_json config;              ///< every setting of the run
  std::vector<std::string> warnings = {};     ///< noticed while the inputs were read
};

/// plan.json as assets/schema/plan.schema.json describes it.
/// @param regions of `plan.classified`; null if there is none.
/// @param explained candidates that the user asked about.
/// @throws Error bad_input if an input file has gone in the meantime.
nlohmann::ordered_json plan_to_json(const Plan& plan, const ShadowRegions* regions,
                                    const std::vector<ViewExplanation>& explained,
                                    const PlanRecord& record);

/// The movable camera.
nlohmann::ordered_json camera_json(const PlanRequest& request);

/// The options that the planner used, for `PlanRecord::config`.
nlohmann::ordered_json config_of(const PlanRequest& request);

}  // namespace vantage
