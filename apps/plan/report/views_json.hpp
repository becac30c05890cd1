#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "vantage/planner/plan.hpp"

namespace vantage {

// What plan.json says of the candidate views and of those that were chosen.

nlohmann::ordered_json best_json(const Plan& plan);
nlohmann::ordered_json views_json(const Plan& plan);
nlohmann::ordered_json ranked_json(const Plan& plan);
nlohmann::ordered_json candidates_json(const Plan& plan);
nlohmann::ordered_json rejections_json(const Plan& plan);
nlohmann::ordered_json explanations_json(const Plan& plan,
                                         const std::vector<ViewExplanation>& explained);

}  // namespace vantage
