#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "mesh/solid_checks.hpp"
#include "mesh/surface_of_revolution.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage {
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
  detail::check_length(radius_m, "radius_m");
  detail::check_length(height_m, "height_m");
  check_segments(segments);
  const double h = height_m / 2;
  return detail::turned({{0, -h}, {radius_m, -h}, {radius_m, h}, {0, h}}, segments, "cylinder");
}

TriangleMesh sphere_solid(double radius_m, int segments) {
  detail::check_length(radius_m, "radius_m");
  check_segments(segments);
  std::vector<detail::ProfilePoint> profile = {{0, -radius_m}};
  for (int i = 1; i < segments / 2; ++i) {
    const double polar = 2 * std::numbers::pi * i / segments;
    profile.push_back({radius_m * std::sin(polar), -radius_m * std::cos(polar)});
  }
  profile.push_back({0, radius_m});
  return detail::turned(profile, segments, "sphere");
}

TriangleMesh cup_solid(double radius_m, double height_m, double wall_m, int segments) {
  detail::check_length(radius_m, "radius_m");
  detail::check_length(height_m, "height_m");
  detail::check_length(wall_m, "wall_m");
  check_segments(segments);
  if (wall_m >= radius_m || wall_m >= height_m) {
    throw bad_input("wall_m", fmt::format("is {} m; expected less than the radius of {} m and the "
                                          "height of {} m",
                                          wall_m, radius_m, height_m));
  }
  const double h = height_m / 2, inner = radius_m - wall_m;
  return detail::turned(
      {{0, -h}, {radius_m, -h}, {radius_m, h}, {inner, h}, {inner, wall_m - h}, {0, wall_m - h}},
      segments, "cup");
}

}  // namespace vantage
