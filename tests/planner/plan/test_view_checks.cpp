#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>

#include "planner/same_plan.hpp"
#include "planner/wall_world.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"

// Checks of the caller's own, beside the built-in constraints.

namespace vantage {
namespace {

using test::small_request;

/// Where the robot's arm is, if not only its reach were known.
const Box kFree({-0.5, -0.2, 0.05}, {0.5, 0.6, 0.5});

bool free_at(const Pose& T_world_cam) {
  return kFree.contains(T_world_cam.translation());
}

WorldModel measured_wall() {
  WorldModel world = test::wall_world();
  DepthCamera& camera = world.cameras[0];
  camera.depth =
      std::make_shared<const DepthImage>(64, 48, std::vector<float>(std::size_t(64 * 48), 0.6f));
  return world;
}

/// Three views by a method, with servoing and polishing.
PlanRequest busy_request(const Method& method) {
  PlanRequest request = small_request();
  request.method = method;
  request.candidates = HalfSpheres{{0.3, 0.45}, {15}, {1, 0.2}};
  request.views.most = 3;
  request.polish.views = 3;
  return request;
}

std::vector<Method> methods() {
  const MeshMethod mesh{.visibility = {.step_px = 2}, .image_width = 64};
  MeshMethod shortlist = mesh;
  shortlist.exact_views = 0;
  shortlist.shortlist_voxel_m = 0.01;
  shortlist.shortlist = 8;
  return {VoxelMethod{}, ShadowMethod{}, LightMethod{}, mesh, shortlist};
}

/// The poses that a plan says the camera may go to: of the candidates that did not win, a few.
constexpr std::size_t kExplained = test::kAllScenes ? 5 : 29;  // one of so many
std::vector<Pose> poses_of(const WorldModel& world, const Plan& plan) {
  std::vector<Pose> poses;
  const auto add = [&](const RankedView& view) {
    poses.push_back(view.T_world_cam);
    for (const PolishStep& step : view.polish) poses.push_back(step.T_world_cam);
  };
  for (const RankedView& view : plan.ranked) add(view);
  for (const NextView& next : plan.views) add(next.view);
  for (std::size_t i = 0; i < plan.candidates.size(); i += kExplained) {
    for (const ScoredStep& step : explain_view(world, plan, plan.candidates[i].view.id).trace) {
      poses.push_back(step.step.T_world_cam);
    }
  }
  return poses;
}

}  // namespace

TEST_CASE("a check forbids candidates, servo iterations, polished poses and further views alike") {
  const WorldModel world = measured_wall();
  std::size_t further = 0;
  for (const Method& method : methods()) {
    CAPTURE(name_of(method));
    PlanRequest request = busy_request(method);
    const auto free_everywhere = poses_of(world, plan_next_view(world, request));
    CHECK_FALSE(std::all_of(free_everywhere.begin(), free_everywhere.end(), free_at));
    request.constraints.checks = {view_check(free_at, "the arm is in the way")};
    const Plan plan = plan_next_view(world, request);
    REQUIRE(plan.best() != nullptr);
    const auto poses = poses_of(world, plan);
    CHECK(std::all_of(poses.begin(), poses.end(), free_at));
    further += plan.views.size() - 1;
  }
  CHECK(further >= 3);
}

TEST_CASE("a check that says what a built-in limit says gives the very same plan" *
          doctest::skip(test::kSanitized)) {
  const WorldModel world = measured_wall();
  for (const Method& method : methods()) {
    CAPTURE(name_of(method));
    PlanRequest built_in = busy_request(method), by_check = built_in;
    built_in.constraints.reach_box = kFree;
    by_check.constraints.checks = {view_check(free_at, "the arm is in the way")};
    test::expect_same_plan(plan_next_view(world, built_in), plan_next_view(world, by_check));
  }
}

TEST_CASE("a plan with checks is the same at any number of threads" *
          doctest::skip(test::kSanitized)) {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const WorldModel world = measured_wall();
  for (const Method& method : methods()) {
    CAPTURE(name_of(method));
    PlanRequest request = busy_request(method);
    request.constraints.checks = {view_check(free_at, "the arm is in the way")};
    const Plan one = tbb::task_arena(1).execute([&] { return plan_next_view(world, request); });
    for (const int threads : {2, 8}) {
      const Plan many =
          tbb::task_arena(threads).execute([&] { return plan_next_view(world, request); });
      test::expect_same_plan(one, many);
      CHECK(rejections_of(one) == rejections_of(many));
    }
  }
}

TEST_CASE("a rejected candidate keeps the words of the check, in plans and explanations") {
  const WorldModel world = measured_wall();
  for (const Method& method : methods()) {
    CAPTURE(name_of(method));
    PlanRequest request = busy_request(method);
    request.constraints.reach = Reach{{0, 0, 0}, 0, 0.42};
    const auto side = [](const Pose& pose) -> std::optional<std::string> {
      const double x = pose.translation().x();
      if (std::abs(x) < 0.2) return std::nullopt;
      return x < 0 ? "joint 2 hits the shelf" : "";
    };
    request.constraints.checks = {view_check(free_at, "the arm is in the way"), side};
    const Plan plan = plan_next_view(world, request);
    constexpr std::size_t kExplainedEach = 3;
    std::map<std::string, std::size_t> counts;
    for (const ScoredCandidate& candidate : plan.candidates) {
      const Eigen::Vector3d p = candidate.view.T_world_cam.translation();
      if (candidate.rejected == InvalidReason::none) {
        CHECK(free_at(candidate.view.T_world_cam));
        CHECK(candidate.check_says.empty());
        continue;
      }
      if (++counts[std::string(candidate.rejection())] <= kExplainedEach) {
        const ViewExplanation view = explain_view(world, plan, candidate.view.id);
        CHECK(view.rejected == candidate.rejected);
        CHECK(view.rejection() == candidate.rejection());
        CHECK(view.verdict == "rejected: " + std::string(candidate.rejection()));
      }
      if (candidate.rejected != InvalidReason::rejected_by_check) {
        CHECK(candidate.rejection() == to_text(candidate.rejected));
        CHECK(candidate.check_says.empty());
      } else if (!kFree.contains(p)) {
        CHECK(candidate.rejection() == "the arm is in the way");  // the first check that says no
      } else {
        CHECK(candidate.rejection() ==
              (p.x() < 0 ? "joint 2 hits the shelf" : "rejected by a check"));
      }
    }
    const auto rejections = rejections_of(plan);
    CHECK(std::map<std::string, std::size_t>(rejections.begin(), rejections.end()) == counts);
    CHECK(counts.count("out of reach") == 1);
    CHECK(counts.count("the arm is in the way") == 1);
    CHECK(counts.count("joint 2 hits the shelf") == 1);
    CHECK(counts.count("rejected by a check") == 1);
  }
}

TEST_CASE("a check is asked only of poses that the built-in constraints allow") {
  PlanRequest request = busy_request(VoxelMethod{});
  request.constraints.reach = Reach{{0, 0, 0}, 0, 0.42};
  const Plan unchecked = plan_next_view(test::wall_world(), request);
  std::size_t built_in = 0;
  for (const ScoredCandidate& candidate : unchecked.candidates) {
    built_in += candidate.rejected != InvalidReason::none;
  }
  CHECK(built_in > 0);
  std::mutex mutex;
  std::set<std::array<double, 3>> asked;
  request.servo.iterations = request.polish.views = 0;
  request.views.most = 1;
  request.constraints.checks = {[&](const Pose& pose) -> std::optional<std::string> {
    const std::lock_guard lock(mutex);
    asked.insert({pose.translation().x(), pose.translation().y(), pose.translation().z()});
    return std::nullopt;
  }};
  const Plan plan = plan_next_view(test::wall_world(), request);
  for (const ScoredCandidate& candidate : plan.candidates) {
    const Eigen::Vector3d p = candidate.view.T_world_cam.translation();
    CHECK(asked.contains({p.x(), p.y(), p.z()}) == (candidate.rejected == InvalidReason::none));
  }
}

TEST_CASE("what a check throws comes out of the plan, and an empty check is refused") {
  PlanRequest request = busy_request(VoxelMethod{});
  request.constraints.checks = {[](const Pose&) -> std::optional<std::string> {
    throw std::runtime_error("no licence for the kinematics");
  }};
  CHECK_THROWS_WITH_AS((void)plan_next_view(test::wall_world(), request),
                       "no licence for the kinematics", std::runtime_error);
  request.constraints.checks = {view_check(free_at, "x"), ViewCheck()};
  test::expect_bad_input("constraints", "check 1 is empty",
                         [&] { (void)plan_next_view(test::wall_world(), request); });
  test::expect_bad_input("constraints", "the check is empty", [] { (void)view_check({}, "x"); });
}

}  // namespace vantage
