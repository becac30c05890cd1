#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/plain_distance.hpp"
#include "simulator/placement/placement.hpp"
#include "simulator/resting_bodies.hpp"
#include "simulator/scene/sample_hash.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {
namespace {

using Eigen::Vector3d;
using Bodies = std::vector<std::shared_ptr<const TriangleMesh>>;

const Box kBoard({-0.25, -0.175, 0.1}, {0.25, 0.175, 1});

std::shared_ptr<const TriangleMesh> shared(TriangleMesh mesh) {
  return std::make_shared<TriangleMesh>(std::move(mesh));
}

/// Some of each: cubes, boxes, cylinders, wedges, balls, brackets.
Bodies clutter(std::size_t count) {
  const Bodies kinds = {
      shared(cuboid(0.05, 0.05, 0.05)), shared(cuboid(0.08, 0.04, 0.02)),
      shared(rod(0.015, 0.06, 16)),     shared(prism({{0, 0}, {0.06, 0}, {0, 0.03}}, 0.04)),
      shared(icosphere(0.02, 1)),       shared(bracket(0.05, 0.008))};
  Bodies bodies;
  for (std::size_t i = 0; i < count; ++i) bodies.push_back(kinds[i % kinds.size()]);
  return bodies;
}

Eigen::AlignedBox3d bounds(const TriangleMesh& mesh, const Pose& T_world_body) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3f& v : mesh.vertices()) box.extend(T_world_body * v.cast<double>());
  return box;
}

// Boxes that are that far apart hold bodies that are no nearer.
constexpr double kFar = 0.01;

// Of two solid bodies, 0 if one lies within the other, and kFar if they are farther apart.
double free_distance(const TriangleMesh& a, const Pose& T_world_a, const TriangleMesh& b,
                     const Pose& T_world_b) {
  if (bounds(a, T_world_a).exteriorDistance(bounds(b, T_world_b)) >= kFar) return kFar;
  const auto corner = [](const TriangleMesh& mesh) {
    return Vector3d(mesh.corner(0, 0).cast<double>());
  };
  if (surrounds(a, T_world_a, T_world_b * corner(b))) return 0;
  if (surrounds(b, T_world_b, T_world_a * corner(a))) return 0;
  return std::min(kFar, surface_distance(a, T_world_a, b, T_world_b));
}

void check_in_area(const TriangleMesh& mesh, const Pose& T_world_body, const Box& area) {
  const Eigen::AlignedBox3d box = bounds(mesh, T_world_body);
  CHECK(std::abs(box.min().z() - area.min().z()) < 1e-9);
  for (int axis = 0; axis < 2; ++axis) {
    CHECK(box.min()[axis] >= area.min()[axis] - 1e-9);
    CHECK(box.max()[axis] <= area.max()[axis] + 1e-9);
  }
}

bool same(const Pose& a, const Pose& b) {
  return a.rotation() == b.rotation() && a.translation() == b.translation();
}

bool is_upright(const Pose& pose) {
  return (pose.rotation().col(2) - Vector3d::UnitZ()).norm() < 1e-6;
}

std::size_t count_upright(const std::vector<Pose>& poses) {
  return std::size_t(std::count_if(poses.begin(), poses.end(), is_upright));
}

}  // namespace

TEST_CASE("placement: twenty bodies of six kinds keep their distance on a small board") {
  const Bodies bodies = clutter(20);
  for (std::uint64_t seed = 1; seed <= scene_count(2); ++seed) {
    CAPTURE(seed);
    const double gap = 0.002;
    const std::vector<Pose> poses = place_at_rest(bodies, {}, {kBoard, seed, gap});
    REQUIRE(poses.size() == bodies.size());
    double least = kFar;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      check_in_area(*bodies[i], poses[i], kBoard);
      for (std::size_t j = 0; j < i; ++j) {
        least = std::min(least, free_distance(*bodies[i], poses[i], *bodies[j], poses[j]));
      }
    }
    CHECK(least >= gap - 1e-9);
    CHECK(least < kFar);  // some are near each other: the check was put to the test
  }
}

TEST_CASE("placement: every body lies in one of its resting poses, turned around z") {
  const Bodies bodies = clutter(12);
  const std::vector<Pose> poses = place_at_rest(bodies, {}, {kBoard, 5});
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::vector<RestingPose> resting = resting_poses(*bodies[i]);
    CHECK(std::any_of(resting.begin(), resting.end(), [&](const RestingPose& pose) {
      const Vector3d up_there = pose.rotation.row(2), up_here = poses[i].rotation().row(2);
      return (up_there - up_here).norm() < 1e-9;
    }));
  }
}

TEST_CASE("placement: the seed decides, to the last bit, and later bodies move no earlier ones") {
  const std::vector<Pose> poses = place_at_rest(clutter(8), {}, {kBoard, 7});
  const std::vector<Pose> again = place_at_rest(clutter(8), {}, {kBoard, 7});
  const std::vector<Pose> more = place_at_rest(clutter(12), {}, {kBoard, 7});
  const std::vector<Pose> other = place_at_rest(clutter(8), {}, {kBoard, 8});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    CHECK(same(poses[i], again[i]));
    CHECK(same(poses[i], more[i]));
    CHECK_FALSE(same(poses[i], other[i]));
  }
}

TEST_CASE("placement: bodies keep off what is fixed, and may stand in its hollow") {
  const auto bin = shared(open_bin(0.16, 0.05, 0.01));
  const auto tower = shared(cuboid(0.3, 0.05, 0.3));
  const std::vector<KnownObject> fixed = {
      {"bin", bin, Pose::from_translation({0.1, 0.02, kBoard.min().z() - 0.0101})},
      {"tower", tower, Pose::from_translation({-0.1, -0.1, 0.3})}};
  const Bodies bodies(24, shared(cuboid(0.03, 0.03, 0.03)));
  const double gap = 1e-5;  // the bin's bottom is a tenth of a millimetre below the floor
  const std::vector<Pose> poses = place_at_rest(bodies, fixed, {kBoard, 3, gap});
  int in_hollow = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    check_in_area(*bodies[i], poses[i], kBoard);
    for (const KnownObject& object : fixed) {
      CHECK(surface_distance(*bodies[i], poses[i], *object.mesh, object.T_world_object) >= gap);
    }
    const Vector3d from_bin = poses[i].translation() - fixed[0].T_world_object.translation();
    in_hollow += from_bin.head<2>().cwiseAbs().maxCoeff() < 0.07;
  }
  CHECK(in_hollow >= 1);
}

TEST_CASE("placement: the requested share of bodies stands upright") {
  const Bodies rods(30, shared(rod(0.008, 0.06, 16)));  // by itself one in seventy stands
  const Box field({0, 0, 0}, {1, 1, 1});
  CHECK(count_upright(place_at_rest(rods, {}, {field, 1, 0.002, 1})) == 30);
  const std::size_t half = count_upright(place_at_rest(rods, {}, {field, 1, 0.002, 0.5}));
  CHECK(half >= 8);
  CHECK(half <= 22);
  CHECK(count_upright(place_at_rest(rods, {}, {field, 1, 0.002, 0})) <= 4);

  // On its tip no body stands, whatever one asks for.
  const Bodies tops(
      3, shared(TriangleMesh(
             {{0, 0, 0}, {0.03f, 0, 0.1f}, {-0.02f, 0.03f, 0.1f}, {-0.02f, -0.03f, 0.1f}},
             {{0, 1, 3}, {0, 2, 1}, {0, 3, 2}, {1, 2, 3}})));
  CHECK(count_upright(place_at_rest(tops, {}, {field, 1, 0.002, 1})) == 0);
}

TEST_CASE("placement: resting poses come as often as their shares say") {
  const Bodies boxes(150, shared(cuboid(0.03, 0.02, 0.012)));
  const std::vector<RestingPose> resting = resting_poses(*boxes[0]);
  const std::vector<Pose> poses = place_at_rest(boxes, {}, {Box({0, 0, 0}, {2, 2, 1}), 4});
  const auto flat = std::count_if(poses.begin(), poses.end(), [](const Pose& pose) {
    return std::abs(pose.rotation()(2, 2)) > 0.9;
  });
  const double share = resting[0].share + resting[1].share;
  CHECK(std::abs(double(flat) / 150 - share) < 3 * std::sqrt(share * (1 - share) / 150));
}

TEST_CASE("placement: when there is no room it says how many are placed") {
  const Bodies cubes(9, shared(cuboid(0.05, 0.05, 0.05)));
  const Box tray({0, 0, 0}, {0.12, 0.1, 1});
  const auto error = caught([&] { place_at_rest(cubes, {}, {tray, 1}); });
  REQUIRE(error);
  CHECK(error->where() == "area");
  check_parts(error->message(), {"of 9 bodies were placed", "0.12 x 0.1 m", "Enlarge the area"});
  const int placed = error->message()[0] - '0';
  CHECK(placed >= 1);
  CHECK(placed <= 3);
  CHECK(place_at_rest(std::span(cubes).first(std::size_t(placed)), {}, {tray, 1}).size() ==
        std::size_t(placed));

  expect_bad_input("area", "0 of 1 bodies were placed", [] {
    place_at_rest(Bodies{shared(cuboid(0.3, 0.3, 0.3))}, {}, {Box({0, 0, 0}, {0.2, 0.2, 1})});
  });
}

TEST_CASE("placement: what cannot be meant is refused") {
  const Bodies cube = clutter(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double gap : {0.0, -1.0, 1e-7, nan, std::numeric_limits<double>::infinity()}) {
    expect_bad_input("gap_m", "expected 1e-06 m or more", [&] {
      place_at_rest(cube, {}, {kBoard, 1, gap});
    });
  }
  for (const double share : {-0.1, 1.1, nan}) {
    expect_bad_input("upright_share", "expected 0 to 1", [&] {
      place_at_rest(cube, {}, {kBoard, 1, 0.002, share});
    });
  }
  expect_bad_input("body 1", "no mesh", [&] {
    place_at_rest(Bodies{cube[0], nullptr}, {}, {kBoard});
  });
  expect_bad_input("body 0", "no triangles",
                   [] { place_at_rest(Bodies{shared(TriangleMesh())}, {}, {kBoard}); });
}

TEST_CASE("counted random numbers are even, and differ with every count") {
  double sum = 0, squares = 0;
  for (std::uint64_t i = 0; i < 10000; ++i) {
    const double u = to_unit(sample_hash(7, i, 3));
    REQUIRE(u >= 0);
    REQUIRE(u < 1);
    sum += u, squares += u * u;
  }
  CHECK(sum / 10000 == doctest::Approx(1.0 / 2).epsilon(0.02));
  CHECK(squares / 10000 == doctest::Approx(1.0 / 3).epsilon(0.03));
  CHECK(to_unit(sample_hash(1, 2)) != to_unit(sample_hash(2, 1)));
  CHECK(to_unit(sample_hash(1, 0)) != to_unit(sample_hash(1, 0, 0)));
}

}  // namespace vantage::test
