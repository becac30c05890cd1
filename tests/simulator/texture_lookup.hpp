#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "simulator/scene/textured_mesh.hpp"

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

/// The triangles that look along `normal`, to 0.04 rad.
inline std::vector<std::size_t> facing(const TriangleMesh& mesh, const Eigen::Vector3d& normal) {
  std::vector<std::size_t> triangles;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const Eigen::Vector3d a = mesh.corner(t, 0).cast<double>();
    const Eigen::Vector3d n = (mesh.corner(t, 1).cast<double>() - a)
                                  .cross(mesh.corner(t, 2).cast<double>() - a)
                                  .normalized();
    if (n.dot(normal) > 0.9992) triangles.push_back(t);
  }
  return triangles;
}

/// The colour at a point that lies on one of these triangles, which are in one plane; nothing
/// beside them.
inline std::optional<std::array<int, 3>> color_at(const TexturedMesh& shape,
                                                  const std::vector<std::size_t>& triangles,
                                                  const Eigen::Vector3d& point) {
  for (const std::size_t t : triangles) {
    const Eigen::Vector3d weights = barycentric(shape.mesh, t, point);
    if (weights.minCoeff() >= -1e-9) return texel_at(shape, t, weights);
  }
  return std::nullopt;
}

}  // namespace vantage::test
