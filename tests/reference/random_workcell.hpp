#pragma once

#include <cstdint>

#include "reference/random_scene.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage::test {

/// One to four turned boxes and sometimes a sphere in a work area of 24 cm, which one to three
/// small cameras look at. Every other camera measures depth: of the known objects and of a foreign
/// box, with holes. With `all_measure`, all of them do.
WorldModel random_workcell(std::uint32_t seed, bool all_measure = false);

/// The work area of random workcells.
Box random_workcell_area();

}  // namespace vantage::test
