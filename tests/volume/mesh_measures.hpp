#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

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

/// How often each directed edge is used, less how often the opposite one is.
struct EdgeUse {
  int balance = 0;
  int count = 0;
};

inline std::map<std::pair<std::uint32_t, std::uint32_t>, EdgeUse> edges_of(
    const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, EdgeUse> edges;
  for (const Triangle& t : mesh.triangles()) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t from = t[c], to = t[(c + 1) % 3];
      EdgeUse& use = edges[std::minmax(from, to)];
      use.balance += from < to ? 1 : -1;
      ++use.count;
    }
  }
  return edges;
}

/// Whether every edge has as many faces on one side as on the other.
inline bool closed(const TriangleMesh& mesh) {
  for (const auto& [edge, use] : edges_of(mesh)) {
    if (use.balance != 0) return false;
  }
  return !mesh.empty();
}

}  // namespace vantage::test
