#pragma once

#include <Eigen/Core>
#include <span>

#include "reference/random_scene.hpp"
#include "vantage/raycore/advanced/picture.hpp"

namespace vantage::test {

/// The slow, obvious twin of render_picture: the mean of `count` samples of one pixel, each a
/// random position, sky and sun direction of its own, one ray after the other. Linear light.
Eigen::Vector3d plain_picture(const Scene& scene, std::span<const Material> materials,
                              const PinholeCamera& camera, const PictureOptions& options, int u,
                              int v, int count, Random& random);

/// sRGB to linear light, by the standard's formula.
double linear_of(double srgb);

}  // namespace vantage::test
