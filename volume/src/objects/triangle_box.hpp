#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace vantage::volume::detail {

/// Whether a triangle touches a closed box; both may be off by rounding of 1e-12 of their size.
/// Separating axes: the box's three, the triangle's normal, and the nine cross products of edges
/// (Akenine-Möller, "Fast 3D triangle-box overlap testing", 2001).
inline bool triangle_touches_box(const std::array<Eigen::Vector3d, 3>& corners,
                                 const Eigen::Vector3d& centre, const Eigen::Vector3d& half) {
  const Eigen::Vector3d a = corners[0] - centre, b = corners[1] - centre, c = corners[2] - centre;
  const auto separates = [&](const Eigen::Vector3d& axis) {
    const double pa = axis.dot(a), pb = axis.dot(b), pc = axis.dot(c);
    const double reach = axis.cwiseAbs().dot(half) * (1 + 1e-12);
    return std::min({pa, pb, pc}) > reach || std::max({pa, pb, pc}) < -reach;
  };
  for (int i = 0; i < 3; ++i) {
    if (separates(Eigen::Vector3d::Unit(i))) return false;
  }
  if (separates((b - a).cross(c - a))) return false;
  for (const Eigen::Vector3d& edge :
       {Eigen::Vector3d(b - a), Eigen::Vector3d(c - b), Eigen::Vector3d(a - c)}) {
    for (int i = 0; i < 3; ++i) {
      if (separates(Eigen::Vector3d::Unit(i).cross(edge))) return false;
    }
  }
  return true;
}

}  // namespace vantage::volume::detail
