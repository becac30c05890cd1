#pragma once

#include <memory>
#include <optional>

#include "reference/random_scene.hpp"
#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/advanced/servo_refiner.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage::test {

/// A random workcell, classified.
PlanningScene shadow_scene(std::uint32_t seed);

/// What hides something there, then all faces of the shadow as one object.
std::shared_ptr<const Scene> all_surfaces(std::uint32_t seed, const StateGrid& grid);

/// A view from anywhere: most look at the shadow from outside, some past it, some from close by or
/// inside of it, some along its faces.
PinholeCamera shadow_view_anywhere(Random& random, const PlanningScene& scene, int width,
                                   int height);

/// A view from a distance at which all of a random workcell is on the image.
PinholeCamera shadow_view_outside(Random& random, int width, int height);

}  // namespace vantage::test
