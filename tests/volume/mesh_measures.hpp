#pragma once

#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::test {

/// Volume inside a closed mesh, by the divergence theorem; negative if it looks inwards.
inline double volume_m3(const TriangleMesh& mesh) {
  double volume = 0;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const Eigen::Vector3d a = mesh.corner(t, 0).cast<double>(),
                          b = mesh.corner(t, 1).cast<double>(),
                          c = mesh.corner(t, 2).cast<double>();
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

inline double area_m2(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const Eigen::Vector3d a = mesh.corner(t, 0).cast<double>(),
                          b = mesh.corner(t, 1).cast<double>(),
                          c = mesh.corner(t, 2).cast<double>();
    sum += (b - a).cross(c - a).norm() / 2;
  }
  return sum;
}

}  // namespace vantage::test
