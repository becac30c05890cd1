#include "mesh/solids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "vantage/raycore/box.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage::raycore::detail {

void check_length(double length_m, const std::string& name) {
  if (std::isfinite(length_m) && length_m > 0) return;
  throw bad_input(name, fmt::format("is {} m; expected a finite length above 0", length_m));
}

void check_size(const Eigen::Vector3d& size_m) {
  if (size_m.allFinite() && size_m.minCoeff() > 0) return;
  throw bad_input("size_m", fmt::format("is ({}, {}, {}) m; expected three finite lengths above 0",
                                        size_m.x(), size_m.y(), size_m.z()));
}

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

}  // namespace vantage::raycore::detail

namespace vantage {
namespace {

/// A profile of (x, z), clockwise where x is to the right and z up, drawn out along y.
TriangleMesh drawn_along_y(const std::vector<Eigen::Vector2d>& profile, double length_m,
                           const std::string& where) {
  raycore::detail::Ring front, back;
  for (const Eigen::Vector2d& p : profile) {
    front.emplace_back(p.x(), -length_m / 2, p.y());
    back.emplace_back(p.x(), length_m / 2, p.y());
  }
  return raycore::detail::ring_stack({front, back}, where);
}

/// Counter-clockwise from above.
raycore::detail::Ring rectangle(double half_x, double half_y, double z) {
  return {{-half_x, -half_y, z}, {half_x, -half_y, z}, {half_x, half_y, z}, {-half_x, half_y, z}};
}

}  // namespace

TriangleMesh box_solid(const Eigen::Vector3d& size_m) {
  raycore::detail::check_size(size_m);
  return TriangleMesh::from_box(Box(-0.5 * size_m, 0.5 * size_m, "size_m"));
}

TriangleMesh wedge_solid(const Eigen::Vector3d& size_m) {
  raycore::detail::check_size(size_m);
  const double x = size_m.x() / 2, z = size_m.z() / 2;
  return drawn_along_y({{-x, -z}, {x, z}, {x, -z}}, size_m.y(), "wedge");
}

TriangleMesh bracket_solid(const Eigen::Vector3d& size_m, double thickness_m) {
  raycore::detail::check_size(size_m);
  raycore::detail::check_length(thickness_m, "thickness_m");
  if (thickness_m >= std::min(size_m.x(), size_m.z())) {
    throw bad_input("thickness_m",
                    fmt::format("is {} m; expected less than the bracket's depth of {} m and its "
                                "height of {} m",
                                thickness_m, size_m.x(), size_m.z()));
  }
  const double x = size_m.x() / 2, z = size_m.z() / 2, t = thickness_m;
  // Begins in the corner between the plates, from where one sees all the others.
  return drawn_along_y({{t - x, t - z}, {x, t - z}, {x, -z}, {-x, -z}, {-x, z}, {t - x, z}},
                       size_m.y(), "bracket");
}

TriangleMesh bin_solid(const Eigen::Vector3d& size_m, double wall_m) {
  raycore::detail::check_size(size_m);
  raycore::detail::check_length(wall_m, "wall_m");
  if (2 * wall_m >= std::min(size_m.x(), size_m.y()) || wall_m >= size_m.z()) {
    throw bad_input("wall_m", fmt::format("is {} m; expected less than half of the bin's length "
                                          "and width ({} m, {} m) and less than its height of {} m",
                                          wall_m, size_m.x(), size_m.y(), size_m.z()));
  }
  const double x = size_m.x() / 2, y = size_m.y() / 2, z = size_m.z() / 2;
  return raycore::detail::ring_stack(
      {rectangle(x, y, -z), rectangle(x, y, z), rectangle(x - wall_m, y - wall_m, z),
       rectangle(x - wall_m, y - wall_m, wall_m - z)},
      "bin");
}

namespace {

constexpr int kMaxSegments = 4096;

void check_segments(int segments) {
  if (segments >= 4 && segments <= kMaxSegments && segments % 2 == 0) return;
  throw bad_input("segments", fmt::format("is {}; expected an even number from 4 to {} (an odd one "
                                          "would leave the bounding box off the axis)",
                                          segments, kMaxSegments));
}

}  // namespace

TriangleMesh cylinder_solid(double radius_m, double height_m, int segments) {
  raycore::detail::check_length(radius_m, "radius_m");
  raycore::detail::check_length(height_m, "height_m");
  check_segments(segments);
  const double h = height_m / 2;
  return raycore::detail::turned({{0, -h}, {radius_m, -h}, {radius_m, h}, {0, h}}, segments,
                                 "cylinder");
}

TriangleMesh sphere_solid(double radius_m, int segments) {
  raycore::detail::check_length(radius_m, "radius_m");
  check_segments(segments);
  std::vector<raycore::detail::ProfilePoint> profile = {{0, -radius_m}};
  for (int i = 1; i < segments / 2; ++i) {
    const double polar = 2 * std::numbers::pi * i / segments;
    profile.push_back({radius_m * std::sin(polar), -radius_m * std::cos(polar)});
  }
  profile.push_back({0, radius_m});
  return raycore::detail::turned(profile, segments, "sphere");
}

TriangleMesh cup_solid(double radius_m, double height_m, double wall_m, int segments) {
  raycore::detail::check_length(radius_m, "radius_m");
  raycore::detail::check_length(height_m, "height_m");
  raycore::detail::check_length(wall_m, "wall_m");
  check_segments(segments);
  if (wall_m >= radius_m || wall_m >= height_m) {
    throw bad_input("wall_m", fmt::format("is {} m; expected less than the radius of {} m and the "
                                          "height of {} m",
                                          wall_m, radius_m, height_m));
  }
  const double h = height_m / 2, inner = radius_m - wall_m;
  return raycore::detail::turned(
      {{0, -h}, {radius_m, -h}, {radius_m, h}, {inner, h}, {inner, wall_m - h}, {0, wall_m - h}},
      segments, "cup");
}

}  // namespace vantage
