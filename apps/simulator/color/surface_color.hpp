#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "simulator/scene/simulated_scene.hpp"
#include "simulator/scene/srgb.hpp"

namespace vantage {

/// The colours of bodies as linear light: how much of each a matt surface sends back.
/// Refers to the bodies; thread-safe.
class SurfaceColors {
 public:
  /// @throws Error bad_input for a colour outside 0 to 1, a texture without texels, and texture
  /// coordinates that are not finite.
  explicit SurfaceColors(std::span<const SimulatedBody> bodies);

  /// Of the nearest texel; beyond the texture's edge its last one. `u` and `v` are the weights of
  /// the triangle's corners 1 and 2.
  Eigen::Vector3f at(ObjectId body, std::uint32_t triangle, float u, float v) const {
    const Look& look = looks_[body];
    if (look.textured == nullptr) return look.color;
    const std::array<Eigen::Vector2f, 3>& corner = look.textured->uv[triangle];
    const Eigen::Vector2f at =
        corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]);
    const ColorImage& texture = look.textured->texture;
    const std::uint8_t* texel =
        texture.pixel(nearest(at.x(), texture.width), nearest(at.y(), texture.height));
    return {linear_[texel[0]], linear_[texel[1]], linear_[texel[2]]};
  }

 private:
  struct Look {
    Eigen::Vector3f color;         ///< linear
    const TexturedMesh* textured;  ///< null: one colour
  };

  /// The texel that spans [i, i + 1).
  static int nearest(float x, int count) {
    return x > 0 ? (x < float(count) ? int(x) : count - 1) : 0;
  }

  std::vector<Look> looks_;
  std::array<float, 256> linear_ = srgb8_to_linear();
};

}  // namespace vantage
