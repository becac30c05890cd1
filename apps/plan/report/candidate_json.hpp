#pragma once

#include <nlohmann/json.hpp>

#include "vantage/planner/view_candidates.hpp"
#include "vantage/planner/view_constraints.hpp"

namespace vantage {

// The options that were used, for plan.json's `config`; with the workcell's keys.

/// Every number is written out: radii that follow from the work area, too. Of poses from a file or
/// a list only how many there are: plan.json's `inputs` have the file.
nlohmann::ordered_json config_of(const CandidateSet& set, const Box& work_area);

/// What is not limited is null.
nlohmann::ordered_json config_of(const ViewConstraints& limits);

}  // namespace vantage
