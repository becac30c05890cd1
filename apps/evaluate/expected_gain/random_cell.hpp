#pragma once

#include <cstdint>

#include "evaluate/planning/planning_cell.hpp"

namespace vantage {

/// A cell that nothing was tuned on: clutter, a bin or a few objects on a table, some of them
/// known; with and without a floor and walls around, known or not; one to four cameras, and sensors
/// of different noise. The same seed gives the same cell.
PlanningCell random_planning_cell(std::uint64_t seed);

}  // namespace vantage
