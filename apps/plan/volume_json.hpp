#pragma once

#include <nlohmann/json.hpp>

#include "vantage/planner/plan.hpp"
#include "vantage/volume/shadow_regions.hpp"

namespace vantage {

// What plan.json says of the work area, all of it as the given cameras left it: what the best view
// would reveal is shadow still. Null (no warnings) if the plan was stopped before that was known.

nlohmann::ordered_json volumes_json(const Plan& plan);
nlohmann::ordered_json anti_alias_json(const Plan& plan);
nlohmann::ordered_json conflicts_json(const Plan& plan);
nlohmann::ordered_json regions_json(const ShadowRegions* regions);
nlohmann::ordered_json warnings_json(const Plan& plan);

}  // namespace vantage
