#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "vantage/raycore/image.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage {

/// A shape and how it looks: one colour, or a picture laid over its triangles. Matt, lit from
/// outside. Shared as `shared_ptr<const TexturedMesh>`.
struct TexturedMesh {
  TriangleMesh mesh;                              ///< metres, in the object's own frame
  Eigen::Vector3f color = {0.75f, 0.75f, 0.75f};  ///< sRGB, 0 to 1; where there is no texture

  /// Where the corners of each triangle lie on `texture`, in texels: (0, 0) is the upper left
  /// corner of the first texel, (width, height) the lower right corner of the last. Empty: no
  /// texture.
  std::vector<std::array<Eigen::Vector2f, 3>> uv = {};
  ColorImage texture = {};

  bool textured() const { return !uv.empty(); }
};

}  // namespace vantage
