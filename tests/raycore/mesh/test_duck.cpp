#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "mesh/surface_nets.hpp"
#include "raycore/closed_mesh.hpp"
#include "support/expect_error.hpp"
#include "vantage/raycore/solids.hpp"

using namespace vantage;
using namespace vantage::test;
using Eigen::Vector3d;

namespace {

const TriangleMesh& duck() {
  static const TriangleMesh kDuck = duck_solid(0.06);
  return kDuck;
}

Vector3d normal(const TriangleMesh& mesh, std::size_t t) {
  const Eigen::Vector3d a = mesh.corner(t, 0).cast<double>();
  return (mesh.corner(t, 1).cast<double>() - a)
      .cross(mesh.corner(t, 2).cast<double>() - a)
      .normalized();
}

}  // namespace

TEST_CASE("a duck is closed, as long as it is to be, and has some thousand faces") {
  const Vector3d size = bounds(duck()).sizes();
  CHECK(size.x() == doctest::Approx(0.06).epsilon(1e-6));
  check_solid(duck(), size);
  CHECK(duck().triangles().size() >= 5000);
  CHECK(duck().triangles().size() <= 15000);
  // Stouter than long and narrower than high, and it fills as much of its box as ducks do.
  CHECK(size.y() > 0.03);
  CHECK(size.z() > size.y());
  CHECK(size.z() < size.x());
  CHECK(volume_m3(duck()) / size.prod() > 0.35);
  CHECK(volume_m3(duck()) / size.prod() < 0.5);
}

TEST_CASE("a duck of another size is the same duck") {
  const TriangleMesh large = duck_solid(0.6);
  CHECK(large.triangles() == duck().triangles());
  double most = 0;
  for (std::size_t i = 0; i < large.vertices().size(); ++i) {
    most = std::max(most, double((large.vertices()[i] - 10 * duck().vertices()[i]).norm()));
  }
  CHECK(most < 1e-7);
}

TEST_CASE("a duck is flat underneath, and nowhere else") {
  const double floor = bounds(duck()).min().z();
  double area = 0;
  for (std::size_t t = 0; t < duck().triangles().size(); ++t) {
    bool below = true;
    for (int i = 0; i < 3; ++i) below = below && duck().corner(t, i).z() == float(floor);
    if (!below) continue;
    CHECK(normal(duck(), t) == Vector3d(0, 0, -1));
    const Eigen::Vector3f a = duck().corner(t, 0);
    area += (duck().corner(t, 1) - a).cross(duck().corner(t, 2) - a).norm() / 2;
  }
  // The cut through the body's ellipsoid by the formula, which the other parts do not reach.
  const double scale = 0.06 / 1.0476, share = 1 - (0.2 * 0.2) / (0.30 * 0.30);
  CHECK(area ==
        doctest::Approx(std::numbers::pi * 0.42 * 0.31 * share * scale * scale).epsilon(0.02));
}

TEST_CASE("a duck is smooth: faces that meet above its floor look nearly the same way") {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> face_of_edge;
  const auto& triangles = duck().triangles();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      face_of_edge[{triangles[t][i], triangles[t][(i + 1) % 3]}] = t;
    }
  }
  const float floor = float(bounds(duck()).min().z());
  int sharp = 0, edges = 0;
  double worst = 1;
  for (const auto& [edge, face] : face_of_edge) {
    if (duck().vertices()[edge.first].z() == floor && duck().vertices()[edge.second].z() == floor) {
      continue;
    }
    const double cosine =
        normal(duck(), face).dot(normal(duck(), face_of_edge.at({edge.second, edge.first})));
    worst = std::min(worst, cosine);
    sharp += cosine < std::cos(20 * std::numbers::pi / 180);
    ++edges;
  }
  CAPTURE(worst);
  CHECK(worst > 0.3);           // no fold
  CHECK(sharp < 0.02 * edges);  // beak, eyes, and where the wings begin
}

TEST_CASE("a duck looks along x, and is the same on both sides") {
  Eigen::Vector3f tip = duck().vertices()[0];
  float left = 0, right = 0;
  for (const Eigen::Vector3f& p : duck().vertices()) {
    if (p.x() > tip.x()) tip = p;
    left = std::max(left, p.y());
    right = std::min(right, p.y());
  }
  CHECK(std::abs(tip.y()) < 0.002f);  // of the beak,
  CHECK(tip.z() > 0.002f);            // which is in the upper half
  CHECK(left == doctest::Approx(-right).epsilon(1e-4));
}

TEST_CASE("ducks of no size are refused") {
  for (const double bad : {0.0, -1.0, double(NAN), std::numeric_limits<double>::infinity()}) {
    expect_refused([&] { duck_solid(bad); }, "length_m", {"finite length above 0"});
  }
  expect_refused([] { duck_solid(1e-44); }, "length_m", {"too small"});
}

TEST_CASE("a surface net of a sphere is closed and lies on it") {
  const raycore::detail::SamplingGrid grid{{-1.3, -1.2, -1.1}, 0.1, {27, 26, 24}};
  const auto net =
      raycore::detail::surface_nets([](const Vector3d& p) { return p.norm() - 1; }, grid);
  std::vector<Eigen::Vector3f> vertices;
  for (const Vector3d& p : net.vertices) {
    CHECK(std::abs(p.norm() - 1) < 0.01);
    vertices.push_back(p.cast<float>());
  }
  const TriangleMesh sphere(vertices, raycore::detail::cut_in_two(net));
  CHECK(is_watertight(sphere));
  CHECK(volume_m3(sphere) == doctest::Approx(4.0 / 3 * std::numbers::pi).epsilon(0.02));
}

TEST_CASE("quadrilaterals are cut along the shorter diagonal") {
  raycore::detail::QuadMesh mesh{{{0, 0, 0}, {1, 0, 0}, {3, 3, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}};
  CHECK(raycore::detail::cut_in_two(mesh) == std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}});
  mesh.vertices[2] = {0.6, 0.6, 0};
  CHECK(raycore::detail::cut_in_two(mesh) == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
}
