#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "vantage/planner/plan.hpp"

namespace vantage {

/// What plan.json says beside the plan itself.
struct PlanRecord {
  double load_s = 0;
  double total_s = 0;
  std::vector<std::filesystem::path> inputs;  ///< every file that was read
  nlohmann::ordered_json config;              ///< every setting of the run
};

/// plan.json as assets/schema/plan.schema.json describes it.
/// @throws Error bad_input if an input file has gone in the meantime.
nlohmann::ordered_json plan_to_json(const Plan& plan, const PlanRecord& record);

/// The settings that the planner used, for `PlanRecord::config`.
nlohmann::ordered_json config_of(const PlanRequest& request);

/// The plan in a few lines for a person.
std::string summary_of(const Plan& plan);

}  // namespace vantage
