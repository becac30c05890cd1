#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "reference/plain_classify.hpp"
#include "reference/random_workcell.hpp"
#include "support/expect_error.hpp"
#include "vantage/planner/plan.hpp"
#include "vantage/planner/voxel_scorer.hpp"
#include "vantage/raycore/scene_builder.hpp"
#include "vantage/volume/classify.hpp"

namespace vantage {
namespace {

PlanRequest small_request() {
  return {.work_area = test::random_workcell_area(),
          .intrinsics = {64, 48, 70, 70, 31.5, 23.5},
          .range = {0.1, 2},
          .voxel_size_m = 0.01};
}

/// A wall across x that one camera sees from -y.
WorldModel wall() {
  WorldModel world;
  world.objects.push_back({"wall",
                           std::make_shared<const TriangleMesh>(
                               TriangleMesh::from_box(Box({-0.1, -0.02, 0}, {0.1, 0.02, 0.18}))),
                           {}});
  world.cameras.push_back({"front",
                           PinholeCamera({64, 48, 70, 70, 31.5, 23.5},
                                         Pose::looking_at({0, -0.6, 0.15}, {0, 0, 0.08}), {0.1, 2}),
                           nullptr});
  return world;
}

}  // namespace

TEST_CASE("the voxel method equals the plain count on random workcells") {
  std::size_t views = 0, revealed = 0;
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    WorldModel world = test::random_workcell(seed);
    for (Observer& camera : world.cameras) camera.depth = nullptr;  // occluders: known objects only
    const GridGeometry geometry = GridGeometry::covering(test::random_workcell_area(), 0.02);
    const auto grid = classify(world, geometry);
    const VoxelScorer scorer(*grid, occluder_scene(world, *grid));
    const test::PlainClassifier plain(world, geometry);
    const Points shadow = grid->centres(VoxelState::shadow);
    for (const ViewCandidate& view : half_sphere_candidates({0, 0, 0.1}, {0.35}, 6)) {
      const PinholeCamera camera({64, 48, 70, 70, 31.5, 23.5}, view.T_world_cam, {0.1, 2});
      const std::vector<std::uint8_t> seen = scorer.revealed(camera);
      std::uint64_t count = 0;
      for (std::size_t i = 0; i < shadow.size(); ++i) {
        bool close_call = false;
        const bool in_view = test::plain_in_view(camera, shadow[i].cast<double>(), close_call);
        const test::Verdict hidden = plain.hidden(camera, shadow[i].cast<double>());
        count += seen[i];
        if (close_call || hidden.close_call) continue;
        REQUIRE(bool(seen[i]) == (in_view && !hidden.hit));
      }
      CHECK(scorer.count_revealed(camera).value() == count);
      ++views;
      revealed += count;
    }
  }
  CHECK(views == 72);
  CHECK(revealed > 5000);
}

TEST_CASE("behind a wall: the plan looks from the other side") {
  const Plan plan = plan_next_view(wall(), small_request());
  REQUIRE(plan.best);
  CHECK(plan.stopped == StopReason::none);
  CHECK(plan.candidates.size() == 40);
  const ScoredCandidate& best = plan.candidates[*plan.best];
  CHECK(best.view.T_world_cam.translation().y() > 0.1);
  CHECK(plan.grid->count(VoxelState::revealed) == *best.revealed_voxels);
  CHECK(*plan.newly_observed_volume_m3(*plan.best) ==
        doctest::Approx(plan.grid->volume_m3(VoxelState::revealed)));
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    const ScoredCandidate& other = plan.candidates[i];
    REQUIRE(other.revealed_voxels);
    CHECK(*other.revealed_voxels <= *best.revealed_voxels);
    if (i < *plan.best) CHECK(*other.revealed_voxels < *best.revealed_voxels);  // ties: lower id
  }
}

TEST_CASE("shadow hides nothing, measured voxels do") {
  WorldModel world = wall();
  SceneBuilder truth;
  truth.add_mesh(*world.objects.front().mesh);
  truth.add_box(Box({-2, -2, -0.1}, {2, 2, 0}));     // the floor, and a wall behind everything:
  truth.add_box(Box({-2, 0.6, -0.1}, {2, 0.7, 2}));  // each pixel has a depth
  world.cameras.front().depth =
      std::make_shared<DepthImage>(truth.build()->render_depth(world.cameras.front().camera));
  world.objects.clear();  // only raw depth is left
  const Plan plan = plan_next_view(world, small_request());
  REQUIRE(plan.best);
  CHECK(plan.candidates[*plan.best].view.T_world_cam.translation().y() > 0.1);
  CHECK(plan.grid->count(VoxelState::occupied) > 100);
}

TEST_CASE("the plan is the same at 1, 2, 3 and 8 threads") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const WorldModel world = test::random_workcell(11);
  PlanRequest request = small_request();
  request.voxel_size_m = 0.004;
  std::optional<Plan> first;
  for (const int threads : {1, 2, 3, 8}) {
    CAPTURE(threads);
    tbb::task_arena arena(threads);
    const Plan plan = arena.execute([&] { return plan_next_view(world, request); });
    if (!first) first = plan;
    CHECK(plan.best == first->best);
    for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
      CHECK(plan.candidates[i].revealed_voxels == first->candidates[i].revealed_voxels);
    }
  }
}

TEST_CASE("with everything out of reach there is no view, and each candidate says why") {
  PlanRequest request = small_request();
  request.reach = Reach{{0, 0, 0}, 0, 0.05};
  const Plan plan = plan_next_view(wall(), request);
  CHECK_FALSE(plan.best);
  CHECK(plan.stopped == StopReason::none);
  for (const ScoredCandidate& candidate : plan.candidates) {
    CHECK(candidate.rejected == "out of reach");
    CHECK_FALSE(candidate.revealed_voxels);
  }
}

TEST_CASE("a plan that is stopped says so and has no half-counted score") {
  const StopToken cancelled;
  cancelled.cancel();
  const Plan none = plan_next_view(wall(), small_request(), cancelled);
  CHECK(none.stopped == StopReason::cancelled);
  CHECK(none.grid == nullptr);
  CHECK_FALSE(none.best);

  PlanRequest request = small_request();
  request.voxel_size_m = 0.001;  // long enough to be interrupted
  const Plan whole = plan_next_view(wall(), request);
  for (const int ms : {50, 200, 400}) {
    const Plan plan = plan_next_view(
        wall(), request,
        StopToken::with_deadline(StopToken::Clock::now() + std::chrono::milliseconds(ms)));
    bool missing = plan.grid == nullptr;
    for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
      const auto& voxels = plan.candidates[i].revealed_voxels;
      missing |= !voxels;
      if (voxels) CHECK(voxels == whole.candidates[i].revealed_voxels);
    }
    CHECK((plan.stopped == StopReason::deadline) == missing);
  }
}

TEST_CASE("planning refuses a request that makes no sense") {
  PlanRequest request = small_request();
  request.intrinsics.fx = -1;
  test::expect_bad_input("movable camera", "fx is -1", [&] { plan_next_view(wall(), request); });
  request = small_request();
  request.voxel_size_m = -0.01;
  test::expect_bad_input("voxel size", "-0.01", [&] { plan_next_view(wall(), request); });
  request = small_request();
  request.radii_m = {0.4, 0};
  test::expect_bad_input("candidates", "0 m", [&] { plan_next_view(wall(), request); });
}

}  // namespace vantage
