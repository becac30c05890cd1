#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "planner/wall_world.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"

namespace vantage {
namespace {

using test::small_request;
using test::wall_world;

double y_of(const Pose& T_world_cam) {
  return T_world_cam.translation().y();
}

bool same_pose(const Pose& a, const Pose& b) {
  return a.translation() == b.translation() && a.rotation() == b.rotation();
}

}  // namespace

TEST_CASE("behind a wall: the plan looks from the other side, whatever the method") {
  for (const std::string method : {"voxel", "shadow", "light"}) {
    for (const int servo : {0, 5}) {
      CAPTURE(method);
      CAPTURE(servo);
      PlanRequest request = small_request();
      request.method = method_named(method);
      request.servo.iterations = servo;
      const Plan plan = plan_next_view(wall_world(), request);
      REQUIRE(plan.best() != nullptr);
      CHECK(plan.stopped == StopReason::none);
      CHECK(plan.finished == 40);
      // Shadow that no image covers is on this side, too; from afar it fills more pixels.
      if (method != "shadow" || servo > 0) CHECK(y_of(plan.best()->T_world_cam) > 0.03);
      CHECK(plan.views.size() == 1);
      CHECK(plan.grid->count(VoxelState::revealed) == plan.views.front().revealed_voxels);
      CHECK(plan.best()->revealed_voxels == plan.views.front().revealed_voxels);
      CHECK(plan.ranked.size() == 10);
      for (std::size_t i = 1; i < plan.ranked.size(); ++i) {
        const RankedView &above = plan.ranked[i - 1], &below = plan.ranked[i];
        const bool tie = above.score == below.score && above.candidate < below.candidate;
        CHECK((above.score > below.score || tie));
      }
    }
  }
}

TEST_CASE("the trace of the best view holds its score, and servoing does not make it worse") {
  PlanRequest request = small_request();
  request.servo.iterations = request.polish.views = 0;
  const Plan still = plan_next_view(wall_world(), request);
  request.polish.views = 2;
  request.servo.iterations = 5;
  const Plan plan = plan_next_view(wall_world(), request);
  CHECK(plan.best()->score >= still.best()->score);
  REQUIRE(plan.trace.size() > std::size_t(plan.best()->servo_iteration));
  for (std::size_t i = 0; i < plan.trace.size(); ++i) {
    REQUIRE(plan.trace[i].score.exact());
    CHECK(plan.trace[i].score.score <= plan.best()->score);
  }
  const bool polished = !plan.best()->polish.empty();
  const ScoredStep& best =
      polished ? plan.trace.back() : plan.trace[std::size_t(plan.best()->servo_iteration)];
  CHECK((best.step.move == ServoMove::polish) == polished);
  CHECK(best.score.score == plan.best()->score);
  CHECK(same_pose(best.step.T_world_cam, plan.best()->T_world_cam));
  CHECK(still.trace.size() == 1);
}

TEST_CASE("polishing makes the best views better, and the rest stays as it is") {
  std::size_t polished = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(6); ++seed) {
    const WorldModel world = test::random_workcell(seed);
    for (const std::string method : {"voxel", "shadow", "light"}) {
      CAPTURE(seed);
      CAPTURE(method);
      PlanRequest request = small_request();
      request.voxel_size_m = 0.02;
      request.method = method_named(method);
      if (seed % 2 == 1) request.search.travel = TravelCost{2, {0.3, 0.3, 0.3}};
      request.polish.views = 0;
      const Plan raw = plan_next_view(world, request);
      request.polish.views = 3;
      const Plan plan = plan_next_view(world, request);
      REQUIRE(plan.ranked.size() == raw.ranked.size());
      std::vector<std::size_t> first, were_first;
      for (std::size_t i = 0; i < plan.ranked.size(); ++i) {
        const RankedView& view = plan.ranked[i];
        const auto was = std::find_if(raw.ranked.begin(), raw.ranked.end(), [&](const auto& other) {
          return other.candidate == view.candidate;
        });
        REQUIRE(was != raw.ranked.end());
        if (i < 3) {
          first.push_back(view.candidate), were_first.push_back(raw.ranked[i].candidate);
        } else {
          CHECK(raw.ranked[i].candidate == view.candidate);
          CHECK(view.polish.empty());
        }
        CHECK((view.utility > was->utility) == !view.polish.empty());
        CHECK(view.servo_iteration == was->servo_iteration);
        const bool sorted = i == 0 || plan.ranked[i - 1].utility > view.utility ||
                            (plan.ranked[i - 1].utility == view.utility &&
                             plan.ranked[i - 1].candidate < view.candidate);
        CHECK(sorted);
        if (view.polish.empty()) {
          CHECK(same_pose(view.T_world_cam, was->T_world_cam));
          continue;
        }
        CHECK(same_pose(view.T_world_cam, view.polish.back().T_world_cam));
        ++polished;
      }
      CHECK(std::is_permutation(first.begin(), first.end(), were_first.begin(), were_first.end()));
    }
  }
  CHECK(polished >= test::enough(10));
}

TEST_CASE("a plan for a grid that is classified already is the same") {
  const PlanRequest request = small_request();
  const Plan whole = plan_next_view(wall_world(), request);
  const Plan plan = plan_next_view(wall_world(), whole.classified, request);
  CHECK(plan.best()->score == whole.best()->score);
  CHECK(same_pose(plan.best()->T_world_cam, whole.best()->T_world_cam));
  CHECK(plan.classify_s == 0);
}

TEST_CASE("shadow hides nothing, measured voxels do") {
  WorldModel world = wall_world();
  SceneBuilder truth;
  truth.add_mesh(*world.objects.front().mesh);
  truth.add_box(Box({-2, -2, -0.1}, {2, 2, 0}));     // the floor, and a wall behind everything:
  truth.add_box(Box({-2, 0.6, -0.1}, {2, 0.7, 2}));  // each pixel has a depth
  world.cameras.front().depth =
      std::make_shared<DepthImage>(truth.build()->render_depth(world.cameras.front().camera));
  world.objects.clear();  // only raw depth is left
  const Plan plan = plan_next_view(world, small_request());
  REQUIRE(plan.best() != nullptr);
  CHECK(y_of(plan.best()->T_world_cam) > 0.1);
  CHECK(plan.grid->count(VoxelState::occupied) > 100);
}

TEST_CASE("the plan is the same at 1, 2, 3 and 8 threads") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const WorldModel world = test::random_workcell(11);
  for (const char* method : {"voxel", "shadow", "light"}) {
    CAPTURE(method);
    PlanRequest request = small_request();
    request.method = method_named(method);
    request.views.most = 3;
    std::optional<Plan> first;
    for (const int threads : {1, 2, 3, 8}) {
      CAPTURE(threads);
      tbb::task_arena arena(threads);
      const Plan plan = arena.execute([&] { return plan_next_view(world, request); });
      if (!first) first = plan;
      REQUIRE(plan.views.size() == first->views.size());
      for (std::size_t i = 0; i < plan.views.size(); ++i) {
        CHECK(same_pose(plan.views[i].view.T_world_cam, first->views[i].view.T_world_cam));
        CHECK(plan.views[i].revealed_voxels == first->views[i].revealed_voxels);
      }
      for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
        CHECK(plan.candidates[i].score == first->candidates[i].score);
      }
    }
  }
}

TEST_CASE("with everything out of reach there is no view, and each candidate says why") {
  PlanRequest request = small_request();
  request.constraints.reach = Reach{{0, 0, 0}, 0, 0.05};
  const Plan plan = plan_next_view(wall_world(), request);
  CHECK(plan.best() == nullptr);
  CHECK(plan.views.empty());
  CHECK(plan.stopped == StopReason::none);
  CHECK(plan.finished == plan.candidates.size());
  for (const ScoredCandidate& candidate : plan.candidates) {
    CHECK(candidate.rejected == InvalidReason::out_of_reach);
    CHECK(candidate.score.known == ScoreBound::Known::nothing);
  }
}

TEST_CASE("where nothing is in shadow, no view is suggested") {
  WorldModel world;
  world.cameras = wall_world().cameras;
  PlanRequest request = small_request();
  request.work_area = Box({-0.02, -0.02, 0.05}, {0.02, 0.02, 0.09});
  for (const char* method : {"voxel", "shadow", "light"}) {
    request.method = method_named(method);
    const Plan plan = plan_next_view(world, request);
    CHECK(plan.classified->count(VoxelState::shadow) == 0);
    CHECK(plan.best() == nullptr);
    CHECK(plan.finished == plan.candidates.size());
  }
}

TEST_CASE("a plan that is stopped says so and has no half-counted score") {
  const StopToken cancelled;
  cancelled.cancel();
  const Plan none = plan_next_view(wall_world(), small_request(), cancelled);
  CHECK(none.stopped == StopReason::cancelled);
  CHECK(none.grid == nullptr);
  CHECK(none.best() == nullptr);

  PlanRequest request = small_request();
  request.voxel_size_m = 0.004;  // long enough to be interrupted
  request.candidates = HalfSpheres{{0.4, 0.6}, {100}, {1}};
  const Plan whole = plan_next_view(wall_world(), request);
  for (const int ms : {5, 20, 60}) {
    const Plan plan = plan_next_view(
        wall_world(), request,
        StopToken::with_deadline(StopToken::Clock::now() + std::chrono::milliseconds(ms)));
    // It may also be stopped while the best views are polished.
    if (plan.grid == nullptr || plan.finished < plan.candidates.size()) {
      CHECK(plan.stopped == StopReason::deadline);
    }
    if (plan.stopped == StopReason::none) CHECK(plan.finished == plan.candidates.size());
    if (plan.stopped != StopReason::none && plan.best() != nullptr) {
      CHECK(plan.best()->polish.empty());
    }
    for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
      const ScoreBound &now = plan.candidates[i].score, &then = whole.candidates[i].score;
      if (now.exact() && then.exact()) CHECK(now.score == then.score);
      if (now.exact() && !then.exact()) CHECK(now.score <= then.score);
    }
    if (plan.best() != nullptr) CHECK(plan.best()->score <= whole.best()->score);
  }
}

TEST_CASE("planning refuses a request that makes no sense") {
  PlanRequest request = small_request();
  request.intrinsics.fx = -1;
  test::expect_bad_input("movable camera", "fx is -1",
                         [&] { plan_next_view(wall_world(), request); });
  request = small_request();
  request.voxel_size_m = -0.01;
  test::expect_bad_input("voxel size", "-0.01", [&] { plan_next_view(wall_world(), request); });
  request = small_request();
  request.candidates = HalfSpheres{{0.4, 0}, {20}, {}};
  test::expect_bad_input("candidates", "0 m", [&] { plan_next_view(wall_world(), request); });
  request = small_request();
  request.method = ShadowMethod{.depth_power = 17};
  test::expect_bad_input("method", "a depth power of 17",
                         [&] { plan_next_view(wall_world(), request); });
  request = small_request();
  request.method = MeshMethod{.enlarge = 0.5};
  test::expect_bad_input("mesh", "scaled by 0.5", [&] { plan_next_view(wall_world(), request); });
  request = small_request();
  request.volume.noise.baseline_m = 0;  // also of a work area that is classified already
  const auto classified = plan_next_view(wall_world(), small_request()).classified;
  test::expect_bad_input("noise.baseline_m", "is 0",
                         [&] { plan_next_view(wall_world(), classified, request); });
  request = small_request();
  request.polish.views = -1;
  test::expect_bad_input("polish", "-1", [&] { plan_next_view(wall_world(), request); });
  request = small_request();
  request.servo.iterations = 101;
  test::expect_bad_input("servo", "101", [&] { plan_next_view(wall_world(), request); });
}

}  // namespace vantage
