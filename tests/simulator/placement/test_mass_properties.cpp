#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "reference/plain_distance.hpp"
#include "simulator/placement/mass_properties.hpp"
#include "simulator/resting_bodies.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {

TEST_CASE("mass properties: a box, a prism and a body of two boxes have the textbook's") {
  const MassProperties box = mass_properties(TriangleMesh::from_box({{1, 2, 3}, {1.2, 2.3, 3.4}}));
  CHECK(box.volume_m3 == doctest::Approx(0.2 * 0.3 * 0.4).epsilon(1e-5));
  CHECK((box.centre - Eigen::Vector3d(1.1, 2.15, 3.2)).norm() < 1e-6);

  const MassProperties wedge = mass_properties(prism({{0, 0}, {0.3, 0}, {0, 0.6}}, 0.2));
  CHECK(wedge.volume_m3 == doctest::Approx(0.018).epsilon(1e-6));
  CHECK((wedge.centre - Eigen::Vector3d(0.1, 0.2, 0)).norm() < 1e-7);

  // 0.1 × 0.1 × 0.01 below and 0.01 × 0.1 × 0.09 upright: ten parts and nine.
  const MassProperties angle = mass_properties(bracket(0.1, 0.01));
  CHECK(angle.volume_m3 == doctest::Approx(1.9e-4).epsilon(1e-5));
  const Eigen::Vector3d expected((10 * 0.05 + 9 * 0.005) / 19, 0.05, (10 * 0.005 + 9 * 0.055) / 19);
  CHECK((angle.centre - expected).norm() < 1e-7);
}

TEST_CASE("mass properties: they move with the body, far from the origin too") {
  Random random(11);
  for (std::uint32_t i = 0; i < scene_count(50); ++i) {
    const TriangleMesh mesh = random_convex_body(random);
    const Pose pose = random.pose(5);
    const MassProperties here = mass_properties(mesh);
    const MassProperties there = mass_properties(mesh.transformed(pose));
    CHECK(there.volume_m3 == doctest::Approx(here.volume_m3).epsilon(1e-4));
    CHECK((there.centre - pose * here.centre).norm() < 1e-6);
  }
}

TEST_CASE("mass properties: counting grid points inside gives the same") {
  Random random(12);
  const TriangleMesh mesh = random_convex_body(random);
  constexpr int kSide = 40;
  constexpr double kCell = 0.2 / kSide;
  int count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const Eigen::Vector3d cell(i % kSide, i / kSide % kSide, i / kSide / kSide);
    const Eigen::Vector3d p =
        kCell * (cell + Eigen::Vector3d::Constant(0.5)) - Eigen::Vector3d::Constant(0.1);
    if (surrounds(mesh, {}, p)) ++count, sum += p;
  }
  const MassProperties properties = mass_properties(mesh);
  CHECK(count * kCell * kCell * kCell == doctest::Approx(properties.volume_m3).epsilon(0.02));
  CHECK((sum / count - properties.centre).norm() < 0.2 * kCell);
}

TEST_CASE("mass properties: meshes without an inside are refused") {
  const TriangleMesh box = cuboid(0.1, 0.1, 0.1);
  std::vector<Triangle> triangles = box.triangles();
  expect_bad_input("mesh", "no triangles", [] { mass_properties({}); });

  for (Triangle& triangle : triangles) std::swap(triangle[0], triangle[1]);
  expect_bad_input("mesh", "faces point inwards", [&] {
    mass_properties({box.vertices(), triangles});
  });

  const std::vector<Eigen::Vector3f> square = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  expect_bad_input("mesh", "a body with an inside", [&] {
    mass_properties({square, {{0, 1, 2}, {0, 2, 1}}});
  });

  triangles = box.triangles();
  triangles.pop_back();
  expect_bad_input("mesh", "its surface is open: it has a hole of about 0.005 m²", [&] {
    mass_properties({box.vertices(), triangles});
  });
}

TEST_CASE("surface points leave out what no triangle uses") {
  const TriangleMesh mesh({{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {8, 8, 8}, {0, 1, 0}},
                          {{1, 2, 4}, {1, 4, 2}});
  const std::vector<Eigen::Vector3d> points = surface_points(mesh);
  REQUIRE(points.size() == 3);
  CHECK(points[2] == Eigen::Vector3d(0, 1, 0));
}

}  // namespace vantage::test
