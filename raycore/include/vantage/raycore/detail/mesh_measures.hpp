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

/// What a mesh encloses, by the divergence theorem.
struct EnclosedVolume {
  Eigen::Vector3d open_m2 = Eigen::Vector3d::Zero();  ///< the faces' areas as vectors along their
                                                      ///< normals: zero for a closed surface
  double area_m2 = 0;                                 ///< the same without directions
  double volume_m3 = 0;  ///< negative for a closed surface that is turned inside out
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the volume; only if there is some
};

/// Parts that overlap count twice, and faces that look inwards bound a hollow.
inline EnclosedVolume enclosed_volume(const TriangleMesh& mesh) {
  // The tip of the tetrahedra is near the mesh, so that large coordinates do not cancel.
  const Eigen::AlignedBox3d bounds = bounds_of(mesh);
  EnclosedVolume sums;
  if (bounds.isEmpty()) return sums;
  const Eigen::Vector3d tip = bounds.center();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
    const Eigen::Vector3d a = mesh.corner(i, 0).cast<double>() - tip;
    const Eigen::Vector3d b = mesh.corner(i, 1).cast<double>() - tip;
    const Eigen::Vector3d c = mesh.corner(i, 2).cast<double>() - tip;
    const Eigen::Vector3d area = 0.5 * (b - a).cross(c - a);
    const double volume = a.dot(b.cross(c)) / 6;
    sums.open_m2 += area;
    sums.area_m2 += area.norm();
    sums.volume_m3 += volume;
    moment += volume / 4 * (a + b + c);
  }
  if (sums.volume_m3 != 0) sums.centre = tip + moment / sums.volume_m3;
  return sums;
}

}  // namespace vantage::raycore::detail
