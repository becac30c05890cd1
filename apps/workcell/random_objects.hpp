#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vantage/raycore/box.hpp"
#include "vantage/raycore/world_model.hpp"
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

/// Sets how many random objects there are, and of which types; what is not given stays.
/// @param types names of types, or of what is above them in the hierarchy; taken in turns. Empty:
/// the workcell's, else all that there are.
/// @throws Error bad_input, "--types" or "--objects" as the place, for a name that is none, and for
/// a workcell without types.
void choose_random_objects(Workcell& workcell, std::optional<int> count,
                           const std::vector<std::string>& types);

/// Adds the workcell's `random_objects` to its known objects, as "<type> 1", "<type> 2", …, at rest
/// on the floor: the board's top inside of the work area, or without a board the work area's lower
/// face. They touch neither each other nor what stands there already, whether it is known or not.
/// The same seed gives the same poses. Does nothing without random objects.
/// @throws Error bad_input as `place_at_rest` does, and where the board lies outside the work area.
void place_random_objects(Workcell& workcell);

/// The floor that random objects may stand on, and all of the work area above it.
/// @throws Error bad_input where the board lies outside the work area.
Box random_object_floor(const Workcell& workcell);

/// What rises above the floor, of these: random objects must not touch it. The floor's own table
/// would be touched by everything.
std::vector<KnownObject> rising_above(std::span<const KnownObject> objects, double floor_z);

}  // namespace vantage
