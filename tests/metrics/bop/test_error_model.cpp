#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "metrics/bop/error_model.hpp"
#include "metrics/turns.hpp"
#include "reference/plain_pose_errors.hpp"
#include "reference/random_scene.hpp"
#include "support/expect_error.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage {
namespace {

using test::turn;

bool same(const Pose& a, const Pose& b) {
  return (test::matrix_of(a) - test::matrix_of(b)).norm() < 1e-9;
}

}  // namespace

TEST_CASE("an object without symmetries has the identity alone") {
  const auto motions = symmetry_motions({});
  REQUIRE(motions.size() == 1);
  CHECK(same(motions[0], Pose()));
}

TEST_CASE("a continuous symmetry is cut into 315 turns, for 1 % of the diameter a step") {
  const Eigen::Vector3d axis(0, 0, 1), offset(0.1, 0.2, 0.3);
  const auto motions = symmetry_motions({.discrete = {}, .continuous = {{axis, offset}}});
  REQUIRE(motions.size() == 315);  // π / 0.01, rounded up
  CHECK(same(motions[0], Pose()));
  for (const std::size_t i : {1u, 100u, 314u}) {
    const double angle = 2 * std::numbers::pi * double(i) / 315;
    CHECK((motions[i].rotation() - turn(angle, axis).rotation()).norm() < 1e-9);
    CHECK((motions[i] * offset - offset).norm() < 1e-12);  // points of the axis stay
    CHECK((motions[i] * (offset + axis) - offset - axis).norm() < 1e-12);
  }
  CHECK(symmetry_motions({.discrete = {}, .continuous = {{axis}}}, 0.5).size() == 7);
}

TEST_CASE("discrete motions come first, then the turns, and two axes stand side by side") {
  const Pose flip = turn(std::numbers::pi, Eigen::Vector3d::UnitX(), {0.01, 0, 0});
  const ContinuousSymmetry around_z{Eigen::Vector3d::UnitZ()};
  const auto motions = symmetry_motions({.discrete = {flip}, .continuous = {around_z}});
  REQUIRE(motions.size() == 2 * 315);
  CHECK(same(motions[315], flip));
  CHECK(same(motions[315 + 10], motions[10] * flip));
  const ContinuousSymmetry around_x{Eigen::Vector3d::UnitX()};
  CHECK(symmetry_motions({.discrete = {}, .continuous = {around_z, around_x}}).size() == 2 * 315);
}

TEST_CASE("diameters are those of all pairs") {
  CHECK(diameter_m({}) == 0);
  CHECK(diameter_m({{1, 2, 3}}) == 0);
  CHECK(diameter_m({{0, 0, 0}, {3, 4, 0}}) == doctest::Approx(5));
  test::Random random(5);
  for (int scene = 0; scene < 20; ++scene) {
    std::vector<Eigen::Vector3d> points;
    for (std::uint32_t i = 0; i < 2 + random.below(60); ++i) points.push_back(random.in_cube(1));
    CHECK(diameter_m(points) == doctest::Approx(test::plain_diameter(points)).epsilon(1e-12));
  }
  const ErrorModel sphere = error_model(sphere_solid(0.03), {});
  CHECK(sphere.diameter_m == doctest::Approx(0.06).epsilon(1e-6));
}

TEST_CASE("a mesh without vertices has no errors") {
  test::expect_bad_input("mesh", "no vertices", [] { error_model(TriangleMesh(), {}); });
}

}  // namespace vantage
