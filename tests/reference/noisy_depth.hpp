#pragma once

#include <memory>

#include "reference/random_scene.hpp"
#include "vantage/raycore/depth_image.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage::test {

/// What a real sensor might measure: the scene's depth with noise that grows with its square, and
/// with holes, both single pixels and a rectangle.
std::shared_ptr<const DepthImage> noisy_depth(const Scene& scene, const PinholeCamera& camera,
                                              Random& random);

/// What is really there in a random workcell: its known objects, a floor, and a box that the world
/// model does not know.
std::shared_ptr<const Scene> scene_with_foreign_box(const WorldModel& world, Random& random);

/// A camera that looks down on the midst of a random workcell.
PinholeCamera random_observer(Random& random);

}  // namespace vantage::test
