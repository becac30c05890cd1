#pragma once

#include <cstdint>

#include "simulator/sequence/sequence_plan.hpp"
#include "vantage/raycore/box.hpp"

namespace vantage {

/// An arm beside the work area that carries what the plan moves, and passes over the table where
/// there is time between two moves. Its shoulder is outside, on the side of +x; away from the table
/// it is drawn back to it.
/// @param floor the part of the world over which it works.
SequenceArm passing_arm(const SequencePlan& plan, const Box& floor, std::uint64_t seed);

}  // namespace vantage
