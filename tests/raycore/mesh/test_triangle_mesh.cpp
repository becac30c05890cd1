#include <doctest/doctest.h>

#include <vantage/raycore/triangle_mesh.hpp>

#include "support/expect_error.hpp"
#include "support/non_finite.hpp"

using namespace vantage;
using Eigen::Vector3d;
using Eigen::Vector3f;

namespace {

const std::vector<Vector3f> kCorners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};

/// Six times the volume that the faces enclose: positive if they look outwards.
double signed_volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
    const Vector3d a = mesh.corner(i, 0).cast<double>();
    const Vector3d b = mesh.corner(i, 1).cast<double>();
    const Vector3d c = mesh.corner(i, 2).cast<double>();
    sum += a.dot(b.cross(c));
  }
  return sum / 6;
}

}  // namespace

TEST_CASE("a mesh keeps its vertices and faces") {
  const TriangleMesh mesh(kCorners, {{0, 1, 2}});
  CHECK(mesh.vertices() == kCorners);
  CHECK(mesh.triangles() == std::vector<Triangle>{{0, 1, 2}});
  CHECK(mesh.corner(0, 1) == Vector3f(1, 0, 0));
  CHECK(mesh.dropped_degenerate() == 0);
  CHECK_FALSE(mesh.empty());
  CHECK(TriangleMesh().empty());
}

TEST_CASE("faces without area are dropped and counted") {
  std::vector<Vector3f> corners = kCorners;
  corners.emplace_back(0, 1, 0);  // 4: where 2 is
  const TriangleMesh mesh(corners, {{0, 1, 1}, {0, 1, 2}, {2, 4, 0}, {0, 1, 3}, {3, 3, 3}});
  CHECK(mesh.triangles() == std::vector<Triangle>{{0, 1, 2}});
  CHECK(mesh.dropped_degenerate() == 4);
}

TEST_CASE("a face with a tiny area is kept") {
  // The area underflows in float, not in double.
  const float small = 1e-30f;
  const TriangleMesh mesh({{0, 0, 0}, {small, 0, 0}, {0, small, 0}}, {{0, 1, 2}});
  CHECK(mesh.triangles().size() == 1);
}

TEST_CASE("vertices that are not finite or too far out are refused with their number") {
  const auto make = [](const Vector3f& p) {
    return TriangleMesh({{0, 0, 0}, {1, 0, 0}, p}, {{0, 1, 2}}, "cube");
  };
  test::expect_bad_input("cube, vertex 2", "(0, nan, 0)", [&] { make({0, test::kNaN, 0}); });
  test::expect_bad_input("cube, vertex 2", "(-inf, 0, 0)", [&] { make({-test::kInfinity, 0, 0}); });
  test::expect_bad_input("cube, vertex 2", "below 1e+06 m", [&] { make({0, 0, 1e6f}); });
  CHECK(make({0, 999999, 0}).triangles().size() == 1);
}

TEST_CASE("an index out of range is refused with its triangle's number") {
  test::expect_bad_input("mesh, triangle 1", "vertex 4; expected an index below 4", [] {
    TriangleMesh(kCorners, {{0, 1, 2}, {0, 1, 4}});
  });
  test::expect_bad_input("mesh, triangle 0", "below 0", [] { TriangleMesh({}, {{0, 0, 0}}); });
}

TEST_CASE("a box has twelve faces that look outwards") {
  const Box box({1, 2, 3}, {2, 4, 7});
  const TriangleMesh mesh = TriangleMesh::from_box(box);
  CHECK(mesh.vertices().size() == 8);
  CHECK(mesh.triangles().size() == 12);
  CHECK(signed_volume(mesh) == doctest::Approx(box.volume_m3()));
  for (std::size_t i = 0; i < 12; ++i) {
    const Vector3f a = mesh.corner(i, 0);
    const Vector3f normal = (mesh.corner(i, 1) - a).cross(mesh.corner(i, 2) - a);
    CHECK(normal.dot(a - box.centre().cast<float>()) > 0);
  }
}

TEST_CASE("scaling multiplies the corners and keeps the count of dropped faces") {
  const TriangleMesh mesh = TriangleMesh(kCorners, {{0, 1, 2}, {0, 0, 1}}).scaled(0.001);
  CHECK(mesh.corner(0, 1) == Vector3f(0.001f, 0, 0));
  CHECK(mesh.dropped_degenerate() == 1);
}

TEST_CASE("an invalid scale factor is refused") {
  const TriangleMesh mesh(kCorners, {{0, 1, 2}});
  test::expect_bad_input("factor", "is 0", [&] { mesh.scaled(0); });
  test::expect_bad_input("factor", "is -1", [&] { mesh.scaled(-1); });
  test::expect_bad_input("factor", "is nan", [&] { mesh.scaled(test::kNaN); });
  test::expect_bad_input("factor", "is inf", [&] { mesh.scaled(test::kInfinity); });
  test::expect_bad_input("scaled mesh, vertex 1", "finite", [&] { mesh.scaled(1e7); });
}

TEST_CASE("the identity moves nothing") {
  const TriangleMesh mesh(kCorners, {{0, 1, 2}, {0, 0, 1}});
  const TriangleMesh moved = mesh.transformed(Pose());
  CHECK(moved.vertices() == mesh.vertices());
  CHECK(moved.triangles() == mesh.triangles());
  CHECK(moved.dropped_degenerate() == 1);
}
