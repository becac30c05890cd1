#include <doctest/doctest.h>

#include <array>

#include "planner/same_plan.hpp"
#include "planner/wall_world.hpp"
#include "support/expect_error.hpp"

namespace vantage {
namespace {

/// A plan by every method, of a wall and a post that were measured.
std::pair<WorldModel, Plan> planned(const Method& method) {
  WorldModel world = test::wall_world();
  world.cameras[0].depth =
      std::make_shared<const DepthImage>(64, 48, std::vector<float>(std::size_t(64 * 48), 0.6f));
  PlanRequest request = test::small_request();
  request.method = method;
  request.candidates = HalfSpheres{{0.3, 0.5}, {6}, {}};
  request.constraints.reach = Reach{{0, 0, 0}, 0, 0.5};
  request.views.most = 2;
  return {world, plan_next_view(world, request)};
}

std::vector<int> all_ids(const Plan& plan) {
  std::vector<int> ids;
  for (const ScoredCandidate& candidate : plan.candidates) ids.push_back(candidate.view.id);
  return ids;
}

void expect_same_explanation(const ViewExplanation& a, const ViewExplanation& b) {
  CHECK(a.candidate.id == b.candidate.id);
  CHECK(a.rejected == b.rejected);
  CHECK(a.verdict == b.verdict);
  CHECK(a.best_step == b.best_step);
  CHECK(a.revealed_voxels == b.revealed_voxels);
  test::expect_same_steps(a.trace, b.trace);
  REQUIRE(a.terms.size() == b.terms.size());
  for (std::size_t i = 0; i < a.terms.size(); ++i) CHECK(a.terms[i].value == b.terms[i].value);
  REQUIRE(a.regions.size() == b.regions.size());
  for (std::size_t i = 0; i < a.regions.size(); ++i) {
    CHECK(a.regions[i].region == b.regions[i].region);
    CHECK(a.regions[i].revealed == b.regions[i].revealed);
  }
}

}  // namespace

TEST_CASE("explanations are by the plan's own scorers, and as good as by new ones") {
  const MeshMethod mesh{.visibility = {.step_px = 2}, .image_width = 64};
  for (const Method& method :
       {Method(VoxelMethod{}), Method(ShadowMethod{}), Method(LightMethod{}), Method(mesh)}) {
    CAPTURE(name_of(method));
    const auto [world, plan] = planned(method);
    REQUIRE(plan.context != nullptr);
    Plan bare = plan;  // a plan is a value: its copies share what scored it
    CHECK(bare.context == plan.context);
    bare.context.reset();
    const std::vector<int> ids = all_ids(plan);
    // Of a world without anything in it, new scorers would find nothing.
    const auto own = explain_views({}, plan, ids), anew = explain_views(world, bare, ids);
    REQUIRE(own.size() == ids.size());
    REQUIRE(anew.size() == ids.size());
    std::size_t scored = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      expect_same_explanation(own[i], anew[i]);
      expect_same_explanation(own[i], explain_view({}, plan, ids[i]));
      scored += own[i].rejected == InvalidReason::none;
    }
    CHECK(scored > 0);
    CHECK(scored < ids.size());
    const Pose& best = plan.best()->T_world_cam;
    CHECK(revealed_voxels({}, plan, best) == *plan.best()->revealed_voxels);
    CHECK(revealed_voxels(world, bare, best) == *plan.best()->revealed_voxels);
  }
}

TEST_CASE("explanations come in the order asked for, and end when stopped") {
  const auto [world, plan] = planned(VoxelMethod{});
  const auto some = explain_views(world, plan, std::array{7, 2, 7});
  REQUIRE(some.size() == 3);
  CHECK(some[0].candidate.id == 7);
  CHECK(some[1].candidate.id == 2);
  CHECK(explain_views(world, plan, {}).empty());
  const StopToken cancelled;
  cancelled.cancel();
  CHECK(explain_views(world, plan, std::array{7, 2}, cancelled).empty());
}

TEST_CASE("what cannot be explained is refused, before anything is") {
  const auto made = planned(VoxelMethod{});
  const auto& world = made.first;
  const auto& plan = made.second;
  test::expect_bad_input("explain", "found candidate 12; expected 0 to 11", [&] {
    (void)explain_views(world, plan, std::array{0, 12});
  });
  const StopToken cancelled;
  cancelled.cancel();
  const Plan none = plan_next_view(world, plan.request, cancelled);
  CHECK(none.context == nullptr);
  test::expect_bad_input("explain", "before the work area was classified",
                         [&] { (void)explain_view(world, none, 0); });
}

}  // namespace vantage
