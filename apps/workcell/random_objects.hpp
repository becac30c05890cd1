#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vantage/reconstruction/object_type.hpp"

namespace vantage {

struct Workcell;

/// Objects that are to lie around at random.
struct RandomObjects {
  int count = 0;
  std::vector<std::shared_ptr<const ObjectType>> types = {};  ///< taken in turns
  std::uint64_t seed = 0;
  double upright_share = 0;  ///< 0 to 1: how many stand as their type usually does
};

/// Adds the workcell's `random_objects` to its known objects, as "<type> 1", "<type> 2", …, at rest
/// on the floor: the board's top inside of the work area, or without a board the work area's lower
/// face. They touch neither each other nor what stands there already, whether it is known or not.
/// The same seed gives the same poses. Does nothing without random objects.
/// @throws Error bad_input as `place_at_rest` does, and where the board lies outside the work area.
void place_random_objects(Workcell& workcell);

}  // namespace vantage
