#include "simulator/resting_bodies.hpp"

#include <cmath>
#include <numbers>

#include "reference/plain_hull.hpp"

namespace vantage::test {

TriangleMesh cuboid(double x_m, double y_m, double z_m) {
  const Eigen::Vector3d half(x_m / 2, y_m / 2, z_m / 2);
  return TriangleMesh::from_box({-half, half});
}

TriangleMesh prism(const std::vector<Eigen::Vector2d>& profile, double height_m) {
  const std::uint32_t n = std::uint32_t(profile.size());
  std::vector<Eigen::Vector3f> vertices;
  for (const double z : {-height_m / 2, height_m / 2}) {
    for (const Eigen::Vector2d& p : profile)
      vertices.push_back({float(p.x()), float(p.y()), float(z)});
  }
  std::vector<Triangle> faces;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    faces.push_back({i, next, n + next});
    faces.push_back({i, n + next, n + i});
    if (i < 2) continue;
    faces.push_back({0, i, i - 1});
    faces.push_back({n, n + i - 1, n + i});
  }
  return {std::move(vertices), std::move(faces)};
}

TriangleMesh rod(double radius_m, double height_m, int sides) {
  std::vector<Eigen::Vector2d> profile;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    profile.push_back({radius_m * std::cos(angle), radius_m * std::sin(angle)});
  }
  return prism(profile, height_m);
}

TriangleMesh bracket(double size_m, double thickness_m) {
  const Box boxes[] = {{{0, 0, 0}, {size_m, size_m, thickness_m}},
                       {{0, 0, thickness_m}, {thickness_m, size_m, size_m}}};
  return TriangleMesh::from_boxes(boxes);
}

TriangleMesh open_bin(double side_m, double height_m, double wall_m) {
  const double r = side_m / 2, i = r - wall_m;
  const Box boxes[] = {{{-r, -r, 0}, {r, r, wall_m}},
                       {{-r, -r, wall_m}, {-i, r, height_m}},
                       {{i, -r, wall_m}, {r, r, height_m}},
                       {{-i, -r, wall_m}, {i, -i, height_m}},
                       {{-i, i, wall_m}, {i, r, height_m}}};
  return TriangleMesh::from_boxes(boxes);
}

TriangleMesh random_convex_body(Random& random) {
  std::vector<Eigen::Vector3f> points;
  for (std::uint32_t i = 0, count = 6 + random.below(14); i < count; ++i) {
    points.push_back((random.uniform(0.04, 0.1) * random.direction()).cast<float>());
  }
  return plain_hull(points);
}

}  // namespace vantage::test
