#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::raycore::detail {

/// Half the solid angle of a triangle as seen from the origin, signed: positive where it is seen
/// from behind (van Oosterom and Strackee, "The solid angle of a plane triangle", 1983).
inline double half_solid_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                               const Eigen::Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return std::atan2(a.dot(b.cross(c)),
                    la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

/// How often a mesh winds around a point: 1 inside of a closed one, 0 outside. Looks at every
/// triangle; for many points volume has a hierarchy.
inline double winding_number(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    sum += half_solid_angle(mesh.corner(t, 0).cast<double>() - point,
                            mesh.corner(t, 1).cast<double>() - point,
                            mesh.corner(t, 2).cast<double>() - point);
  }
  return sum / (2 * double(EIGEN_PI));
}

/// The axis-aligned box around a mesh in its own frame; empty for an empty mesh.
inline Eigen::AlignedBox3d bounds_of(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& vertex : mesh.vertices()) box.extend(vertex.cast<double>());
  return box;
}

}  // namespace vantage::raycore::detail
