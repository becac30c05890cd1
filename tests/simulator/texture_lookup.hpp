#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "simulator/textured_mesh.hpp"

namespace vantage::test {

/// The texel at a triangle's barycentric coordinates: the slow, obvious way.
inline std::array<int, 3> texel_at(const TexturedMesh& shape, std::size_t triangle,
                                   const Eigen::Vector3d& weights) {
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
  for (int i = 0; i < 3; ++i) {
    uv += weights[i] * shape.uv[triangle][std::size_t(i)].cast<double>();
  }
  const std::uint8_t* texel = shape.texture.pixel(int(std::floor(uv.x())), int(std::floor(uv.y())));
  return {texel[0], texel[1], texel[2]};
}

/// Weights of the triangle's corners at a point of its plane.
inline Eigen::Vector3d barycentric(const TriangleMesh& mesh, std::size_t triangle,
                                   const Eigen::Vector3d& point) {
  const Eigen::Vector3d a = mesh.corner(triangle, 0).cast<double>(),
                        b = mesh.corner(triangle, 1).cast<double>(),
                        c = mesh.corner(triangle, 2).cast<double>();
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const double wb = normal.dot((point - a).cross(c - a)) / normal.squaredNorm();
  const double wc = normal.dot((b - a).cross(point - a)) / normal.squaredNorm();
  return {1 - wb - wc, wb, wc};
}

/// The colour at a point of the surface that looks along `normal`; nothing if there is none.
inline std::optional<std::array<int, 3>> color_at(const TexturedMesh& shape,
                                                  const Eigen::Vector3d& point,
                                                  const Eigen::Vector3d& normal) {
  for (std::size_t t = 0; t < shape.mesh.triangles().size(); ++t) {
    const Eigen::Vector3d a = shape.mesh.corner(t, 0).cast<double>();
    const Eigen::Vector3d n = (shape.mesh.corner(t, 1).cast<double>() - a)
                                  .cross(shape.mesh.corner(t, 2).cast<double>() - a)
                                  .normalized();
    if (n.dot(normal) < 0.999 || std::abs(n.dot(point - a)) > 2e-4) continue;
    const Eigen::Vector3d weights = barycentric(shape.mesh, t, point);
    if (weights.minCoeff() >= -1e-9) return texel_at(shape, t, weights);
  }
  return std::nullopt;
}

}  // namespace vantage::test
