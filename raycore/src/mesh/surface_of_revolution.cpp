#include "mesh/surface_of_revolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "vantage/raycore/error.hpp"

namespace vantage::detail {
namespace {

/// A ring's vertices in the mesh.
struct Range {
  std::uint32_t first = 0, count = 0;
  std::uint32_t operator[](std::uint32_t i) const { return first + i % count; }
};

void connect(const Range& below, const Range& above, std::vector<Triangle>& triangles) {
  for (std::uint32_t i = 0; i < std::max(below.count, above.count); ++i) {
    if (below.count > 1) triangles.push_back({below[i], below[i + 1], above[i + 1]});
    if (above.count > 1) triangles.push_back({below[i], above[i + 1], above[i]});
  }
}

void close(const Range& ring, bool at_end, std::vector<Triangle>& triangles) {
  for (std::uint32_t i = 1; i + 1 < ring.count; ++i) {
    if (at_end) {
      triangles.push_back({ring[0], ring[i], ring[i + 1]});
    } else {
      triangles.push_back({ring[0], ring[i + 1], ring[i]});
    }
  }
}

}  // namespace

TriangleMesh ring_stack(const std::vector<Ring>& rings, const std::string& where) {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Triangle> triangles;
  Range last;
  for (const Ring& ring : rings) {
    const Range range{std::uint32_t(vertices.size()), std::uint32_t(ring.size())};
    for (const Eigen::Vector3d& corner : ring) vertices.push_back(corner.cast<float>());
    if (last.count == 0) {
      close(range, false, triangles);
    } else {
      connect(last, range, triangles);
    }
    last = range;
  }
  close(last, true, triangles);
  TriangleMesh mesh(std::move(vertices), std::move(triangles), where);
  if (mesh.dropped_degenerate() > 0) {
    throw bad_input(where,
                    "the sizes make faces without area; expected lengths that differ by less "
                    "than a factor of a million");
  }
  return mesh;
}

TriangleMesh turned(const std::vector<ProfilePoint>& profile, int segments,
                    const std::string& where) {
  std::vector<Ring> rings;
  for (const ProfilePoint& point : profile) {
    Ring& ring = rings.emplace_back();
    for (int i = 0; i < (point.radius_m == 0 ? 1 : segments); ++i) {
      const double angle = 2 * std::numbers::pi * i / segments;
      ring.emplace_back(point.radius_m * std::cos(angle), point.radius_m * std::sin(angle),
                        point.z_m);
    }
  }
  return ring_stack(rings, where);
}

}  // namespace vantage::detail
