#pragma once

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "vantage/raycore/triangle_mesh.hpp"
#include "volume/mesh_measures.hpp"

namespace vantage::test {

/// Each directed edge once, and its opposite once; no vertex without a face.
inline bool is_watertight(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  std::vector<bool> used(mesh.vertices().size(), false);
  for (const Triangle& t : mesh.triangles()) {
    for (std::size_t i = 0; i < 3; ++i) {
      ++edges[{t[i], t[(i + 1) % 3]}];
      used[t[i]] = true;
    }
  }
  for (const auto& [edge, count] : edges) {
    const auto opposite = edges.find({edge.second, edge.first});
    if (count != 1 || opposite == edges.end()) return false;
  }
  return !mesh.empty() && std::find(used.begin(), used.end(), false) == used.end();
}

inline Eigen::AlignedBox3d bounds(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& p : mesh.vertices()) box.extend(p.cast<double>());
  return box;
}

/// What holds for every solid: closed, outwards, with this bounding box around the origin.
inline void check_solid(const TriangleMesh& mesh, const Eigen::Vector3d& size_m) {
  CHECK(is_watertight(mesh));
  CHECK(mesh.dropped_degenerate() == 0);
  CHECK(volume_m3(mesh) > 0);
  const Eigen::Vector3d least = bounds(mesh).min(), most = bounds(mesh).max();
  CAPTURE(least.transpose());
  CAPTURE(most.transpose());
  CHECK((least + most).norm() < 1e-6 * size_m.norm());
  CHECK((most - least - size_m).norm() < 1e-6 * size_m.norm());
}

/// Crossings of a ray from `point` through the mesh, outward faces less inward ones: 1 inside of a
/// solid, 0 outside.
inline int winding(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  // Crooked, so that it meets no edge of a mesh that is made along the axes.
  const Eigen::Vector3d direction = Eigen::Vector3d(0.5377, 0.3121, 0.7831).normalized();
  int sum = 0;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const Eigen::Vector3d a = mesh.corner(t, 0).cast<double>() - point,
                          b = mesh.corner(t, 1).cast<double>() - point,
                          c = mesh.corner(t, 2).cast<double>() - point;
    const double u = direction.dot(b.cross(c)), v = direction.dot(c.cross(a)),
                 w = direction.dot(a.cross(b));
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) continue;
    if ((b - a).cross(c - a).dot(a) / (u + v + w) < 0) continue;
    sum += u + v + w > 0 ? 1 : -1;
  }
  return sum;
}

}  // namespace vantage::test
