#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <thread>

#include "planner/wall_world.hpp"
#include "reference/plain_view_check.hpp"
#include "reference/random_boxes.hpp"
#include "support/scene_count.hpp"
#include "vantage/planner/advanced/view_validity_checker.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage::test {
namespace {

constexpr DepthRange kRange{0.02, 3};
const Eigen::Vector3d kMiddle(0, 0, 0.1);  // of the random worlds

std::shared_ptr<const ReachMap> random_map(Random& random) {
  ReachMap map{{-0.4, -0.4, -0.1}, 0.1, {8, 7, 6}, std::vector<std::uint8_t>(8 * 7 * 6)};
  for (std::uint8_t& cell : map.reachable) cell = random.below(4) != 0;
  return std::make_shared<const ReachMap>(map);
}

ViewConstraints random_limits(Random& random) {
  ViewConstraints limits = ViewConstraints::bare();
  const auto sometimes = [&] { return random.below(4) == 0; };
  if (sometimes()) limits.reach = Reach{random.in_cube(0.3), 0.1, random.uniform(0.4, 0.8)};
  if (sometimes()) limits.reach_box = Box({-0.4, -0.3, 0.01}, {0.3, 0.4, random.uniform(0.2, 0.5)});
  if (sometimes()) limits.reach_map = random_map(random);
  if (sometimes()) limits.view_cone = ViewCone{random.direction(), random.uniform(0.8, 3.1)};
  if (random.below(2) == 0) limits.clearance_m = random.uniform(0, 0.05);
  const std::uint32_t body = random.below(4);
  if (body == 1) limits.body = SphereBody{random.uniform(0, 0.04)};
  if (body == 2) {
    const Eigen::Vector3d min = random.in_cube(0.03);
    limits.body = BoxBody{Box(min, min + Eigen::Vector3d(0.03, 0.02, random.uniform(0.01, 0.1)))};
  }
  if (body == 3) limits.body = d435_body();
  return limits;
}

Pose random_pose(Random& random) {
  return Pose::from_translation(kMiddle) * random.pose(random.below(2) == 0 ? 0.15 : 0.4);
}

}  // namespace

TEST_CASE("the checker agrees with its slow twin, for every reason") {
  std::map<InvalidReason, std::size_t> seen;
  std::size_t close_calls = 0;
  for (std::uint32_t seed = 0; seed < scene_count(30); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const BoxWorld boxes = random_boxes(seed, 0.02);
    const WorldModel world = boxes.model();
    const auto grid = classify(world, boxes.geometry);
    const PlanningScene scene(world, grid, OccluderMode::mesh);
    for (int i = 0; i < 10; ++i) {
      const ViewConstraints limits = random_limits(random);
      const ViewValidityChecker validity(limits, scene, kRange);
      for (int j = 0; j < 4; ++j) {
        const Pose pose = random_pose(random);
        const auto expected = plain_view_check(world, *grid, limits, kRange, pose);
        if (!expected) {
          ++close_calls;
          continue;
        }
        CAPTURE(to_text(*expected));
        REQUIRE(validity.check(pose) == *expected);
        ++seen[*expected];
      }
    }
  }
  for (int reason = 0; reason <= int(InvalidReason::too_close_to_occupied); ++reason) {
    CAPTURE(to_text(InvalidReason(reason)));
    CHECK(seen[InvalidReason(reason)] >= enough(10));
  }
  CHECK(close_calls < 20);
}

TEST_CASE("with voxels as occluders, distances are to the voxels") {
  // A ball of 2 voxels' radius; beside it, at the height of its middle, a corner of voxels is gone.
  WorldModel world;
  world.objects.push_back({"ball", std::make_shared<const TriangleMesh>(icosphere(0.04, 2)),
                           Pose::from_translation({0, 0, 0.1})});
  world.cameras.push_back(
      {"above",
       PinholeCamera({200, 200, 60, 60, 99.5, 99.5}, Pose::looking_at({0, 0, 0.6}, {0, 0, 0})),
       nullptr});
  const auto grid =
      classify(world, GridGeometry::covering(Box({-0.2, -0.2, 0}, {0.2, 0.2, 0.2}), 0.02));
  const Pose beside = Pose::looking_at({0.07, 0, 0.15}, {1, 0, 0.15});
  const auto distance = [&](OccluderMode mode) {
    const PlanningScene scene(world, grid, mode);
    double distance_m = 0;
    while (ViewValidityChecker({.clearance_m = distance_m, .body = {}}, scene, {1e-6, 3})
               .check(beside) == InvalidReason::none)
      distance_m += 1e-4;
    return distance_m;
  };
  const double to_ball = std::hypot(0.07, 0.05) - 0.04;
  CHECK(std::abs(distance(OccluderMode::mesh) - to_ball) < 2e-3);
  // The nearest voxel's corner is at x = 0.04, z = 0.12.
  CHECK(std::abs(distance(OccluderMode::voxels) - std::hypot(0.03, 0.03)) < 2e-4);
}

TEST_CASE("a body stays out of unseen volume, whatever hides it") {
  const WorldModel world = wall_world();
  const auto grid = classify(world, GridGeometry::covering(random_workcell_area(), 0.01));
  const Pose behind = Pose::looking_at({0, 0.35, 0.09}, {0, 0, 0.09});  // looks into the shadow
  for (const OccluderMode mode : {OccluderMode::mesh, OccluderMode::voxels}) {
    const PlanningScene scene(world, grid, mode);
    const auto with_nose = [&](double length_m) {
      const BoxBody body{Box({-0.005, -0.005, -0.02}, {0.005, 0.005, length_m})};
      return ViewValidityChecker({.clearance_m = 0.01, .body = body}, scene, {0.02, 3})
          .check(behind);
    };
    double length_m = 0.01;  // until it touches
    while (with_nose(length_m) == InvalidReason::none) length_m += 1e-3;
    CHECK(with_nose(length_m) == InvalidReason::body_in_unseen);
    const Eigen::Vector3d tip = behind * Eigen::Vector3d(0, 0, length_m + 0.005);
    const auto voxel = grid->geometry().voxel_at(tip);
    REQUIRE(voxel);
    CHECK(grid->at(*voxel) == VoxelState::shadow);
  }
}

TEST_CASE("shadow is as close with a wall before it, whatever stands for the wall") {
  const WorldModel world = wall_world();
  const auto grid = classify(world, GridGeometry::covering(random_workcell_area(), 0.01));
  const Pose before = Pose::looking_at({0, -0.05, 0.09}, {0, 0, 0.09});
  for (const OccluderMode mode : {OccluderMode::mesh, OccluderMode::voxels}) {
    const PlanningScene scene(world, grid, mode);
    const ViewConstraints bare = ViewConstraints::bare();
    CHECK(ViewValidityChecker(bare, scene, {0.06, 3}).check(before) == InvalidReason::none);
    CHECK(ViewValidityChecker(bare, scene, {0.08, 3}).check(before) ==
          InvalidReason::too_close_to_shadow);
  }
}

TEST_CASE("many threads may check at once") {
  const BoxWorld boxes = random_boxes(7, 0.02);
  const WorldModel world = boxes.model();
  const PlanningScene scene(world, classify(world, boxes.geometry), OccluderMode::mesh);
  const ViewValidityChecker validity({.clearance_m = 0.02, .body = SphereBody{0.01}}, scene,
                                     kRange);
  const auto check_all = [&] {
    Random random(1);
    std::vector<InvalidReason> reasons;
    for (int i = 0; i < 2000; ++i) reasons.push_back(validity.check(random_pose(random)));
    return reasons;
  };
  const std::vector<InvalidReason> alone = check_all();
  std::vector<InvalidReason> together[4];
  std::vector<std::thread> threads;
  for (auto& reasons : together) threads.emplace_back([&] { reasons = check_all(); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& reasons : together) CHECK(reasons == alone);
}

}  // namespace vantage::test
