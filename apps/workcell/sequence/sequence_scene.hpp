#pragma once

#include "simulator/sequence/random_sequence.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

/// What a workcell's sequences take place in: its known objects that have a type are those that may
/// be moved, and everything else in it never moves. With random objects placed.
/// @param distortion of the colour cameras.
/// @throws Error bad_input for a workcell without cameras, and as `random_object_floor` and `Lens`
/// do.
SequenceScene sequence_scene(const Workcell& workcell, const Distortion& distortion = {});

}  // namespace vantage
