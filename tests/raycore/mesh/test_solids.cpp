#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "raycore/closed_mesh.hpp"
#include "support/expect_error.hpp"
#include "support/non_finite.hpp"
#include "vantage/raycore/solids.hpp"

using namespace vantage;
using namespace vantage::test;
using Eigen::Vector3d;

namespace {

constexpr double kPi = std::numbers::pi;

/// The area of a regular polygon with its corners on a circle.
double polygon_area(double radius, int corners) {
  return 0.5 * corners * radius * radius * std::sin(2 * kPi / corners);
}

/// Whether the volume is that of the formula, to what single-precision corners allow.
bool has_volume(const TriangleMesh& mesh, double volume) {
  return std::fabs(volume_m3(mesh) - volume) < 1e-5 * volume;
}

/// Compares the mesh with a formula for what is inside, at points in and around `size`.
void check_inside(const TriangleMesh& mesh, const Vector3d& size,
                  const std::function<bool(const Vector3d&)>& inside) {
  std::mt19937 random(1);
  int wrong = 0;
  for (int i = 0; i < 3000; ++i) {
    Vector3d p;
    for (int a = 0; a < 3; ++a) p[a] = 1.2 * size[a] * (random() / 4294967296.0 - 0.5);
    wrong += winding(mesh, p) != int(inside(p));
  }
  CHECK(wrong == 0);
}

bool in_box(const Vector3d& p, const Vector3d& low, const Vector3d& high) {
  return (p.array() > low.array()).all() && (p.array() < high.array()).all();
}

}  // namespace

TEST_CASE("a box") {
  const Vector3d size(0.1, 0.2, 0.3);
  const TriangleMesh box = box_solid(size);
  check_solid(box, size);
  CHECK(has_volume(box, 0.006));
  CHECK(box.triangles().size() == 12);
  check_inside(box, size, [&](const Vector3d& p) { return in_box(p, -size / 2, size / 2); });
}

TEST_CASE("a cylinder") {
  for (const int segments : {4, 6, 48}) {
    CAPTURE(segments);
    const TriangleMesh cylinder = cylinder_solid(0.03, 0.1, segments);
    const double y = segments == 6 ? 0.03 * std::sqrt(3) : 0.06;  // hexagons are narrower
    check_solid(cylinder, {0.06, y, 0.1});
    CHECK(has_volume(cylinder, 0.1 * polygon_area(0.03, segments)));
  }
  CHECK(volume_m3(cylinder_solid(0.03, 0.1)) ==
        doctest::Approx(kPi * 0.03 * 0.03 * 0.1).epsilon(0.003));
}

TEST_CASE("a sphere: all its corners lie on it, and it bulges everywhere") {
  const TriangleMesh sphere = sphere_solid(0.05);
  check_solid(sphere, {0.1, 0.1, 0.1});
  CHECK(volume_m3(sphere) == doctest::Approx(4.0 / 3 * kPi * std::pow(0.05, 3)).epsilon(0.005));
  for (const Eigen::Vector3f& p : sphere.vertices()) {
    REQUIRE(std::abs(p.cast<double>().norm() - 0.05) < 1e-8);
  }
  for (std::size_t t = 0; t < sphere.triangles().size(); ++t) {
    const Vector3d a = sphere.corner(t, 0).cast<double>(), b = sphere.corner(t, 1).cast<double>(),
                   c = sphere.corner(t, 2).cast<double>();
    // No face is farther from the sphere than its size allows: about (0.05 m)(2 pi / 64)² / 4.
    REQUIRE((b - a).cross(c - a).normalized().dot(a) > 0.0498);
  }
  check_solid(sphere_solid(2, 4), {4, 4, 4});
  CHECK(has_volume(sphere_solid(2, 4), 8 * 8.0 / 6));  // an octahedron
}

TEST_CASE("a wedge rises along x") {
  const Vector3d size(0.2, 0.1, 0.05);
  const TriangleMesh wedge = wedge_solid(size);
  check_solid(wedge, size);
  CHECK(has_volume(wedge, size.prod() / 2));
  check_inside(wedge, size, [&](const Vector3d& p) {
    return in_box(p, -size / 2, size / 2) && p.z() < 0.25 * p.x();
  });
}

TEST_CASE("a cup is open at the top") {
  const TriangleMesh cup = cup_solid(0.04, 0.1, 0.003);
  check_solid(cup, {0.08, 0.08, 0.1});
  CHECK(has_volume(cup, 0.1 * polygon_area(0.04, 48) - 0.097 * polygon_area(0.037, 48)));
  CHECK(winding(cup, {0, 0, -0.0485}) == 1);     // in the bottom
  CHECK(winding(cup, {0, 0, -0.046}) == 0);      // above it
  CHECK(winding(cup, {0.0385, 0, 0.049}) == 1);  // in the wall
}

TEST_CASE("a bracket is a floor plate and a back plate") {
  const Vector3d size(0.08, 0.05, 0.06);
  const TriangleMesh bracket = bracket_solid(size, 0.01);
  check_solid(bracket, size);
  CHECK(has_volume(bracket, 0.05 * (0.08 * 0.01 + 0.05 * 0.01)));
  check_inside(bracket, size, [&](const Vector3d& p) {
    return in_box(p, -size / 2, size / 2) && (p.z() < -0.02 || p.x() < -0.03);
  });
}

TEST_CASE("a bin has four walls and a bottom") {
  const Vector3d size(0.4, 0.3, 0.2);
  const TriangleMesh bin = bin_solid(size, 0.01);
  check_solid(bin, size);
  CHECK(has_volume(bin, size.prod() - 0.38 * 0.28 * 0.19));
  check_inside(bin, size, [&](const Vector3d& p) {
    return in_box(p, -size / 2, size / 2) && !in_box(p, {-0.19, -0.14, -0.09}, {0.19, 0.14, 0.1});
  });
}

TEST_CASE("sizes that are not positive and finite are refused") {
  for (const double bad : {0.0, -0.1, double(kNaN), double(kInfinity)}) {
    for (int axis = 0; axis < 3; ++axis) {
      Vector3d size(0.1, 0.1, 0.1);
      size[axis] = bad;
      for (const auto& make : std::initializer_list<std::function<TriangleMesh()>>{
               [&] { return box_solid(size); }, [&] { return wedge_solid(size); },
               [&] { return bracket_solid(size, 0.01); }, [&] { return bin_solid(size, 0.01); }}) {
        expect_refused(make, "size_m", {"expected three finite lengths above 0"});
      }
    }
    expect_refused([&] { cylinder_solid(bad, 1); }, "radius_m", {"finite length above 0"});
    expect_refused([&] { cylinder_solid(1, bad); }, "height_m", {"finite length above 0"});
    expect_refused([&] { sphere_solid(bad); }, "radius_m", {"finite length above 0"});
    expect_refused([&] { cup_solid(bad, 1, 0.1); }, "radius_m", {"finite length above 0"});
    expect_refused([&] { cup_solid(1, bad, 0.1); }, "height_m", {"finite length above 0"});
    expect_refused([&] { cup_solid(1, 1, bad); }, "wall_m", {"finite length above 0"});
    expect_refused([&] { bin_solid({1, 1, 1}, bad); }, "wall_m", {"finite length above 0"});
    expect_refused([&] { bracket_solid({1, 1, 1}, bad); }, "thickness_m", {"above 0"});
  }
}

TEST_CASE("sizes that do not go together are refused") {
  expect_refused([] { cup_solid(0.04, 0.1, 0.04); }, "wall_m", {"0.04 m", "radius"});
  expect_refused([] { cup_solid(0.04, 0.03, 0.03); }, "wall_m", {"0.03 m", "height"});
  expect_refused([] { bracket_solid({0.1, 0.1, 0.05}, 0.05); }, "thickness_m", {"0.05 m"});
  expect_refused([] { bracket_solid({0.05, 0.1, 0.1}, 0.05); }, "thickness_m", {"0.05 m"});
  expect_refused([] { bin_solid({0.2, 0.4, 0.3}, 0.1); }, "wall_m", {"0.1 m", "half"});
  expect_refused([] { bin_solid({0.4, 0.2, 0.3}, 0.1); }, "wall_m", {"0.1 m", "half"});
  expect_refused([] { bin_solid({1, 1, 0.1}, 0.1); }, "wall_m", {"0.1 m", "height"});
  expect_refused([] { cup_solid(1, 1, 1e-12); }, "cup", {"faces without area"});
  for (const int bad : {-2, 2, 5, 4098}) {
    expect_refused([&] { cylinder_solid(1, 1, bad); }, "segments", {"even number from 4 to 4096"});
    expect_refused([&] { sphere_solid(1, bad); }, "segments", {"even number from 4 to 4096"});
    expect_refused([&] { cup_solid(1, 1, 0.1, bad); }, "segments", {"even number from 4 to 4096"});
  }
}
