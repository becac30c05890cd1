#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "planner/wall_world.hpp"
#include "support/expect_error.hpp"
#include "vantage/planner/advanced/voxel_scorer.hpp"

namespace vantage {
namespace {

/// Four posts: each view leaves something for the next one.
WorldModel posts_world() {
  WorldModel world = test::wall_world();
  world.objects.clear();
  const auto post = std::make_shared<const TriangleMesh>(
      TriangleMesh::from_box(Box({-0.025, -0.025, 0}, {0.025, 0.025, 0.14})));
  for (const double x : {-0.07, 0.07}) {
    for (const double y : {-0.07, 0.07}) {
      world.objects.push_back({"post", post, Pose::from_translation({x, y, 0})});
    }
  }
  return world;
}

PlanRequest k_views(int most) {
  PlanRequest request = test::small_request();
  request.intrinsics.fx = request.intrinsics.fy = 250;  // one view covers some 8 cm
  request.candidates = HalfSpheres{{0.3, 0.4}, {8}, {1, 0.2}};
  request.constraints.reach = Reach{{0, 0, 0.1}, 0.28, 0.42};  // and cannot back off
  request.views.most = most;
  return request;
}

/// Which shadow voxels each pose would reveal.
std::vector<std::vector<std::uint8_t>> revealed_sets(const WorldModel& world, const Plan& plan,
                                                     const std::vector<Pose>& poses) {
  const PlanningScene scene(world, plan.classified, plan.request.volume.occluders);
  const VoxelScorer scorer(scene);
  std::vector<std::vector<std::uint8_t>> sets;
  for (const Pose& pose : poses) {
    sets.push_back(
        scorer.revealed(PinholeCamera(plan.request.intrinsics, pose, plan.request.range)));
  }
  return sets;
}

std::uint64_t gain(const std::vector<std::uint8_t>& set, const std::vector<std::uint8_t>& left) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < set.size(); ++i) count += set[i] & left[i];
  return count;
}

}  // namespace

TEST_CASE("further views are those that plain greedy takes") {
  const WorldModel world = posts_world();
  PlanRequest request = k_views(4);
  request.servo.iterations = request.polish.views = 0;
  const Plan plan = plan_next_view(world, request);
  REQUIRE(plan.views.size() == 4);
  std::vector<Pose> poses;
  for (const ScoredCandidate& candidate : plan.candidates) {
    poses.push_back(candidate.view.T_world_cam);
  }
  const auto sets = revealed_sets(world, plan, poses);
  std::vector<std::uint8_t> left(sets.front().size(), 1);
  for (const NextView& next : plan.views) {
    std::size_t best = 0;
    for (std::size_t c = 1; c < sets.size(); ++c) {
      const bool feasible = plan.candidates[c].rejected == InvalidReason::none;
      if (feasible && gain(sets[c], left) > gain(sets[best], left)) best = c;
    }
    CHECK(next.view.candidate == best);
    CHECK(next.revealed_voxels == gain(sets[best], left));
    for (std::size_t i = 0; i < left.size(); ++i) left[i] &= std::uint8_t(1 - sets[best][i]);
  }
  CHECK(plan.grid->count(VoxelState::shadow) ==
        std::uint64_t(std::count(left.begin(), left.end(), std::uint8_t(1))));
}

TEST_CASE("greedy views reveal at least 1 - 1/e of what the best views can") {
  const WorldModel world = posts_world();
  PlanRequest request = k_views(2);
  request.servo.iterations = request.polish.views = 0;
  const Plan plan = plan_next_view(world, request);
  std::vector<Pose> poses;
  for (const ScoredCandidate& candidate : plan.candidates) {
    if (candidate.rejected == InvalidReason::none) poses.push_back(candidate.view.T_world_cam);
  }
  const auto sets = revealed_sets(world, plan, poses);
  std::uint64_t best = 0;
  for (const auto& a : sets) {
    for (const auto& b : sets) {
      std::uint64_t both = 0;
      for (std::size_t i = 0; i < a.size(); ++i) both += a[i] | b[i];
      best = std::max(best, both);
    }
  }
  const std::uint64_t ours = plan.views[0].revealed_voxels + plan.views[1].revealed_voxels;
  CHECK(double(ours) >= (1 - std::exp(-1)) * double(best));
  CHECK(ours <= best);
}

TEST_CASE("with servoing, further views are the best of all iterations of all candidates") {
  const WorldModel world = posts_world();
  PlanRequest request = k_views(3);
  request.polish.views = 0;
  const Plan plan = plan_next_view(world, request);
  REQUIRE(plan.views.size() == 3);
  std::vector<Pose> poses;
  for (const ScoredCandidate& candidate : plan.candidates) {
    for (const ScoredStep& step : explain_view(world, plan, candidate.view.id).trace) {
      poses.push_back(step.step.T_world_cam);
    }
  }
  const auto sets = revealed_sets(world, plan, poses);
  std::vector<std::uint8_t> left(sets.front().size(), 1);
  for (const NextView& next : plan.views) {
    std::uint64_t best = 0;
    for (const auto& set : sets) best = std::max(best, gain(set, left));
    CHECK(next.revealed_voxels == best);
    const auto taken = revealed_sets(world, plan, {next.view.T_world_cam}).front();
    for (std::size_t i = 0; i < left.size(); ++i) left[i] &= std::uint8_t(1 - taken[i]);
  }
}

TEST_CASE("each further view is polished in the shadow that those before it left") {
  const WorldModel world = posts_world();
  const Plan plan = plan_next_view(world, k_views(3));
  REQUIRE(plan.views.size() == 3);
  std::vector<Pose> before, after;
  for (const NextView& next : plan.views) {
    const auto trace =
        explain_view(world, plan, plan.candidates[next.view.candidate].view.id).trace;
    before.push_back(trace[std::size_t(next.view.servo_iteration)].step.T_world_cam);
    after.push_back(next.view.T_world_cam);
  }
  const auto unpolished = revealed_sets(world, plan, before);
  const auto polished = revealed_sets(world, plan, after);
  std::vector<std::uint8_t> left(polished.front().size(), 1);
  std::size_t better = 0;
  for (std::size_t v = 0; v < plan.views.size(); ++v) {
    CHECK(plan.views[v].revealed_voxels == gain(polished[v], left));
    const bool moved = !plan.views[v].view.polish.empty();
    CHECK((gain(polished[v], left) > gain(unpolished[v], left)) == moved);
    better += moved;
    for (std::size_t i = 0; i < left.size(); ++i) left[i] &= std::uint8_t(1 - polished[v][i]);
  }
  CHECK(better >= 2);
}

TEST_CASE("every method plans several views, none of them twice") {
  for (const std::string method : {"voxel", "shadow", "light"}) {
    CAPTURE(method);
    PlanRequest request = k_views(3);
    request.method = method_named(method);
    const Plan plan = plan_next_view(posts_world(), request);
    REQUIRE(plan.views.size() >= 2);
    std::uint64_t revealed = 0;
    for (const NextView& next : plan.views) {
      CHECK(next.revealed_voxels > 0);
      revealed += next.revealed_voxels;
    }
    CHECK(plan.grid->count(VoxelState::revealed) == revealed);
    if (method == "voxel") CHECK(plan.views[0].revealed_voxels >= plan.views[1].revealed_voxels);
  }
}

TEST_CASE("views end where they are not worth it") {
  PlanRequest request = k_views(100);
  const Plan all = plan_next_view(posts_world(), request);
  CHECK(all.views.size() < 100);  // nothing is left to reveal
  CHECK(all.views.size() > 3);
  CHECK(all.stopped == StopReason::none);
  request.views.min_gain_m3 = 0.9 * all.volume_m3(all.views[1].revealed_voxels);
  const Plan some = plan_next_view(posts_world(), request);
  CHECK(some.views.size() < all.views.size());
  CHECK(some.views.size() >= 2);
  request.views = {100, 0, 1};
  CHECK(plan_next_view(posts_world(), request).views.size() == 1);
}

TEST_CASE("a high travel cost keeps the camera near") {
  PlanRequest request = k_views(2);
  const Eigen::Vector3d here(0.3, 0.1, 0.2);
  request.search.travel = TravelCost{0, here};
  const Plan free = plan_next_view(posts_world(), request);
  request.search.travel->weight_per_m = 30;
  const Plan costly = plan_next_view(posts_world(), request);
  const auto distance = [](const NextView& next, const Eigen::Vector3d& from) {
    return (next.view.T_world_cam.translation() - from).norm();
  };
  CHECK(distance(costly.views[0], here) < distance(free.views[0], here));
  CHECK(costly.best()->utility < costly.best()->score);
  CHECK(free.best()->utility == free.best()->score);
  // The second journey begins where the first one ended.
  CHECK(distance(costly.views[1], costly.views[0].view.T_world_cam.translation()) < 0.2);
}

TEST_CASE("an explanation adds up") {
  const WorldModel world = posts_world();
  PlanRequest request = k_views(1);
  request.constraints.reach = Reach{{0.1, 0, 0}, 0, 0.4};
  const Plan plan = plan_next_view(world, request);
  std::set<std::string> kinds;
  for (const ScoredCandidate& candidate : plan.candidates) {
    const ViewExplanation view = explain_view(world, plan, candidate.view.id);
    kinds.insert(view.verdict.substr(0, view.verdict.find(' ')));
    CHECK((view.rejected == InvalidReason::none) == (candidate.rejected == InvalidReason::none));
    if (view.rejected != InvalidReason::none) continue;
    const ScoredStep& best = view.trace[view.best_step];
    for (const ScoredStep& step : view.trace) CHECK(step.score.score <= best.score.score);
    CHECK(best.score.score <= plan.best()->score);
    const bool told = view.verdict.find("(polished)") != std::string::npos;
    CHECK(told == (best.step.move == ServoMove::polish || !plan.best()->polish.empty()));
    CHECK(view.revealed_voxels == best.score.score);  // method voxel
    if (candidate.score.exact()) {                    // before polishing
      const auto at = std::size_t(candidate.servo_iteration);
      CHECK(candidate.score.score == view.trace[at].score.score);
      CHECK((at == view.best_step) == (best.step.move != ServoMove::polish));
    }
    std::uint64_t sum = 0;
    for (const RegionGain& region : view.regions) {
      CHECK(region.revealed <= region.voxels);
      sum += region.revealed;
    }
    CHECK(sum == view.revealed_voxels);
    CHECK(view.terms.back().value == doctest::Approx(plan.in_units(best.score.score)).scale(0));
    CHECK(revealed_voxels(world, plan, best.step.T_world_cam) == view.revealed_voxels);
  }
  CHECK(kinds == std::set<std::string>{"lost:", "rejected:", "the"});
  test::expect_bad_input("explain", "found candidate 144; expected 0 to 143",
                         [&] { explain_view(world, plan, 144); });
}

}  // namespace vantage
