#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "support/expect_error.hpp"
#include "vantage/planner/view_candidates.hpp"
#include "vantage/volume/classify.hpp"

namespace vantage {
namespace {

std::shared_ptr<const StateGrid> empty_grid() {
  return classify({}, GridGeometry::covering(Box({-0.1, -0.1, 0}, {0.1, 0.1, 0.2}), 0.01));
}

ViewCandidate at(const Eigen::Vector3d& eye) {
  return {0, Pose::looking_at(eye, {0, 0, 0.11})};
}

}  // namespace

TEST_CASE("a half-sphere has exactly as many directions as asked for, all above the horizon") {
  for (int count = 1; count <= 300; ++count) {
    CAPTURE(count);
    const auto directions = half_sphere_directions(count);
    REQUIRE(directions.size() == std::size_t(count));
    for (const Eigen::Vector3d& d : directions) {
      REQUIRE(d.norm() == doctest::Approx(1));
      REQUIRE(d.z() > 0);
    }
  }
}

TEST_CASE("twenty directions are Deserno's rings of 3, 7 and 10") {
  const auto directions = half_sphere_directions(20);
  const auto on_ring = [&](double degrees) {
    return std::count_if(directions.begin(), directions.end(), [&](const Eigen::Vector3d& d) {
      return std::abs(std::acos(d.z()) * 180 / std::numbers::pi - degrees) < 1e-9;
    });
  };
  CHECK(on_ring(15) == 3);
  CHECK(on_ring(45) == 7);
  CHECK(on_ring(75) == 10);
}

TEST_CASE("every ring gets its share of the directions, rounded up or down") {
  for (int count = 1; count <= 300; ++count) {
    std::map<double, int> rings;  // by z
    for (const Eigen::Vector3d& d : half_sphere_directions(count)) ++rings[d.z()];
    double circumferences = 0;
    const double spacing =
        std::numbers::pi / 2 / std::max(1.0, std::round(std::sqrt(std::numbers::pi * count / 8)));
    for (double polar = spacing / 2; polar < std::numbers::pi / 2; polar += spacing) {
      circumferences += std::sin(polar);
    }
    CAPTURE(count);
    for (const auto& [z, points] : rings) {
      REQUIRE(std::abs(points - count * std::sqrt(1 - z * z) / circumferences) < 1);
    }
  }
}

TEST_CASE("directions are spread evenly") {
  for (const int count : {20, 100, 456, 1369}) {
    CAPTURE(count);
    const auto directions = half_sphere_directions(count);
    const double spacing = std::sqrt(2 * std::numbers::pi / count);  // of a square with one point
    for (std::size_t i = 0; i < directions.size(); ++i) {
      double nearest = 10;
      for (std::size_t j = 0; j < directions.size(); ++j) {
        if (i != j) nearest = std::min(nearest, (directions[i] - directions[j]).norm());
      }
      REQUIRE(nearest > 0.6 * spacing);
      REQUIRE(nearest < 1.4 * spacing);
    }
  }
}

TEST_CASE("candidates count up over the half-spheres and look at the centre") {
  const Eigen::Vector3d centre(0.1, -0.2, 0.05);
  const auto candidates = half_sphere_candidates(centre, {0.5, 0.9}, 20);
  REQUIRE(candidates.size() == 40);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Pose& pose = candidates[i].T_world_cam;
    CHECK(candidates[i].id == int(i));
    CHECK((pose.translation() - centre).norm() == doctest::Approx(i < 20 ? 0.5 : 0.9));
    const Eigen::Vector3d towards = (centre - pose.translation()).normalized();
    CHECK(pose.rotation().col(2).dot(towards) == doctest::Approx(1));
    CHECK(pose.rotation().col(1).z() <= 0);  // the image is not upside down
  }
}

TEST_CASE("impossible candidates are refused with the value") {
  test::expect_bad_input("candidates", "0 positions", [] { half_sphere_directions(0); });
  test::expect_bad_input("candidates", "-0.5 m", [] {
    half_sphere_candidates({0, 0, 0}, {-0.5}, 20);
  });
  test::expect_bad_input("candidates", "inf", [] {
    half_sphere_candidates({0, 0, 0}, {std::numeric_limits<double>::infinity()}, 20);
  });
  test::expect_bad_input("reach", "from 0.9 to 0.5", [] {
    Reach{{0, 0, 0}, 0.9, 0.5}.check("reach");
  });
}

TEST_CASE("every reason to reject a pose") {
  const auto grid = empty_grid();  // no camera: all of it is shadow
  const Reach reach{{0, 0, 0}, 0.3, 0.8};
  CHECK_FALSE(reason_to_reject(at({0.5, 0, 0.2}), reach, *grid));
  CHECK(reason_to_reject(at({0.5, 0, -0.1}), reach, *grid).value() == "below the floor");
  CHECK(reason_to_reject(at({0.9, 0, 0.2}), reach, *grid).value() == "out of reach");
  CHECK(reason_to_reject(at({0.15, 0, 0.2}), reach, *grid).value() == "out of reach");
  CHECK_FALSE(reason_to_reject(at({0.9, 0, 0.2}), std::nullopt, *grid));
  CHECK(reason_to_reject(at({0.05, 0, 0.1}), std::nullopt, *grid).value() == "inside shadow");

  WorldModel world;
  world.objects.push_back(
      {"all",
       std::make_shared<const TriangleMesh>(TriangleMesh::from_box(Box({-1, -1, -1}, {1, 1, 1}))),
       {}});
  const auto solid = classify(world, grid->geometry());
  CHECK(reason_to_reject(at({0.05, 0, 0.1}), std::nullopt, *solid).value() ==
        "inside occupied volume");
}

}  // namespace vantage
