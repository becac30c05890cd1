#pragma once

#include <string>
#include <vector>

#include "vantage/planner/plan.hpp"
#include "vantage/volume/advanced/shadow_regions.hpp"

namespace vantage {

/// The plan in a few lines for a person.
/// @param regions of `plan.classified`; null if there is none.
/// @param explained candidates that the user asked about.
std::string summary_of(const Plan& plan, const ShadowRegions* regions,
                       const std::vector<ViewExplanation>& explained);

}  // namespace vantage
