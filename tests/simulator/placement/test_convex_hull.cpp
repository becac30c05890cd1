#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "simulator/placement/convex_hull.hpp"
#include "simulator/placement/mass_properties.hpp"
#include "simulator/resting_bodies.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {
namespace {

void check_closed(const std::vector<HullFace>& faces, const std::vector<Eigen::Vector3d>& points) {
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const HullFace& face = faces[i];
    CHECK(face.normal.norm() == doctest::Approx(1));
    double highest = -1;
    for (const Eigen::Vector3d& p : points) {
      highest = std::max(highest, face.normal.dot(p - face.centre));
    }
    CHECK(std::abs(highest) < 1e-6);
    Eigen::Vector3d round_trip = Eigen::Vector3d::Zero(), area = Eigen::Vector3d::Zero();
    for (const HullEdge& edge : face.edges) {
      round_trip += edge.b - edge.a;
      area += (edge.a - face.centre).cross(edge.b - face.centre);
      REQUIRE(edge.beyond < faces.size());
      const auto& others = faces[edge.beyond].edges;
      const bool mutual = std::any_of(others.begin(), others.end(), [&](const HullEdge& other) {
        return other.beyond == i && (other.a - edge.b).norm() + (other.b - edge.a).norm() < 1e-7;
      });
      CHECK(mutual);
    }
    CHECK(round_trip.norm() < 1e-9);
    CHECK(area.normalized().dot(face.normal) > 1 - 1e-6);  // they go around it to the left
  }
}

}  // namespace

TEST_CASE("convex hull: of random points it is that of the plain search") {
  Random random(21);
  for (std::uint32_t i = 0; i < scene_count(100); ++i) {
    const TriangleMesh mesh = random_convex_body(random);
    const std::vector<Eigen::Vector3d> points = surface_points(mesh);
    const std::vector<HullFace> faces = convex_hull_faces(points);
    check_closed(faces, points);
    REQUIRE(faces.size() == mesh.triangles().size());
    for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
      const Eigen::Vector3d a = mesh.corner(t, 0).cast<double>(),
                            b = mesh.corner(t, 1).cast<double>(),
                            c = mesh.corner(t, 2).cast<double>();
      const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
      CHECK(std::any_of(faces.begin(), faces.end(), [&](const HullFace& face) {
        return (face.normal - normal).norm() < 1e-9;
      }));
    }
  }
}

TEST_CASE("convex hull: flat sides that rounding to floats has bent stay whole") {
  Random random(22);
  for (std::uint32_t i = 0; i < scene_count(60); ++i) {
    const Pose pose = random.pose(0.3);
    const double size = random.uniform(0.01, 1);
    const auto points_of = [&](const TriangleMesh& mesh) {
      return surface_points(mesh.scaled(size).transformed(pose));
    };
    CHECK(convex_hull_faces(points_of(cuboid(1, 0.5, 0.7))).size() == 6);
    CHECK(convex_hull_faces(points_of(rod(0.3, 0.8, 48))).size() == 50);
    const std::vector<Eigen::Vector3d> corner = points_of(bracket(1, 0.1));
    const std::vector<HullFace> faces = convex_hull_faces(corner);
    CHECK(faces.size() == 7);  // five sides of a box, and a slope between two slabs' edges
    check_closed(faces, corner);
  }
}

TEST_CASE("convex hull: a smooth body keeps its many faces") {
  const std::vector<Eigen::Vector3d> points = surface_points(icosphere(0.05, 4));
  const std::vector<HullFace> faces = convex_hull_faces(points);
  check_closed(faces, points);
  CHECK(faces.size() == 5120);
}

TEST_CASE("convex hull: points in a plane are refused, with Qhull's reason") {
  const std::vector<Eigen::Vector3d> square = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  expect_bad_input("mesh", "Qhull says: QH6154", [&] { convex_hull_faces(square); });
  expect_bad_input("mesh", "it has 3 corners; expected the four or more",
                   [&] { convex_hull_faces(std::span(square).first(3)); });
}

}  // namespace vantage::test
