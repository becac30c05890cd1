// Polygons of any shape become triangles that cover them once.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>
#include <vantage/raycore/mesh_io.hpp>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"

using namespace vantage;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// The polygon as an OBJ, turned in space.
TriangleMesh triangles_of(const std::vector<Vector2d>& polygon, const Eigen::Quaterniond& turn) {
  std::string text, face = "f";
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d p = turn * Vector3d(polygon[i].x(), polygon[i].y(), 0.3);
    text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", p.x(), p.y(), p.z());
    face += fmt::format(" {}", i + 1);
  }
  const test::TemporaryFolder folder;
  return read_mesh(folder.write("a.obj", text + face + "\n"));
}

double signed_area(const std::vector<Vector2d>& polygon) {
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

/// Triangles that all look as the polygon does and have its area together overlap nowhere.
void expect_covered(const std::vector<Vector2d>& polygon) {
  for (const double angle : {0.0, 0.7, 2.0, std::numbers::pi}) {
    CAPTURE(angle);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Vector3d(1, -2, 0.5).normalized()));
    const TriangleMesh mesh = triangles_of(polygon, turn);
    CHECK(mesh.triangles().size() + mesh.dropped_degenerate() == polygon.size() - 2);
    const Vector3d normal = turn * Vector3d(0, 0, signed_area(polygon) < 0 ? -1 : 1);
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
      const Vector3d a = mesh.corner(t, 0).cast<double>();
      const double part =
          0.5 *
          normal.dot(
              (mesh.corner(t, 1).cast<double>() - a).cross(mesh.corner(t, 2).cast<double>() - a));
      CHECK(part > -1e-6);
      area += part;
    }
    CHECK(area == doctest::Approx(std::abs(signed_area(polygon))).epsilon(1e-5));
  }
}

}  // namespace

TEST_CASE("a concave polygon is not cut into a fan") {
  const std::vector<Vector2d> letter_u = {{0, 0}, {3, 0}, {3, 3}, {2, 3},
                                          {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  expect_covered(letter_u);
  expect_covered({letter_u.rbegin(), letter_u.rend()});
  expect_covered({{0, 0}, {1, 0.2}, {2, 0}, {1, 2}});  // a dart, from whichever corner
  expect_covered({{1, 2}, {0, 0}, {1, 0.2}, {2, 0}});
}

TEST_CASE("corners on straight sides stay corners of triangles") {
  const std::vector<Vector2d> square = {{0, 0},    {0.5, 0}, {1, 0},   {1, 1},
                                        {0.25, 1}, {0, 1},   {0, 0.75}};
  for (std::size_t first = 0; first < square.size(); ++first) {
    std::vector<Vector2d> polygon = square;
    std::rotate(polygon.begin(), polygon.begin() + std::ptrdiff_t(first), polygon.end());
    const TriangleMesh mesh = triangles_of(polygon, Eigen::Quaterniond::Identity());
    CHECK(mesh.dropped_degenerate() == 0);
    expect_covered(polygon);
  }
}

TEST_CASE("a hole that a bridge makes part of the border") {
  expect_covered({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}});
}

TEST_CASE("random stars and spirals") {
  std::mt19937 random(5);
  for (int n = 0; n < 30; ++n) {
    std::vector<Vector2d> star;
    const std::size_t corners = 4 + random() % 60;
    for (std::size_t i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * double(i) / double(corners);
      const double radius = 0.2 + double(random() % 1000) / 1000;
      star.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    expect_covered(star);
  }
  std::vector<Vector2d> spiral, back;
  for (int i = 0; i < 100; ++i) {
    const double angle = 0.2 * i, radius = 1 + 0.1 * i;
    spiral.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    back.emplace_back((radius + 0.5) * std::cos(angle), (radius + 0.5) * std::sin(angle));
  }
  spiral.insert(spiral.end(), back.rbegin(), back.rend());
  expect_covered(spiral);
}

TEST_CASE("a polygon that crosses itself, and one that takes too many tests, come to an end") {
  const TriangleMesh bow =
      triangles_of({{0, 0}, {2, 2}, {2, 0}, {0, 1}}, Eigen::Quaterniond::Identity());
  CHECK(bow.triangles().size() + bow.dropped_degenerate() == 2);
  // A comb: every ear is cut off by the others' teeth.
  std::string text, face = "f";
  const int teeth = 40000;
  for (int i = 0; i < teeth; ++i) {
    text += fmt::format("v {} {} 0\n", i % 2 == 0 ? i : i + 1000 * (i % 7), i % 3);
    face += fmt::format(" {}", i + 1);
  }
  const test::TemporaryFolder folder;
  const auto file = folder.write("a.obj", text + face + "\n");
  test::expect_bad_input("a.obj", "too complex", [&] { read_mesh(file); });
}
