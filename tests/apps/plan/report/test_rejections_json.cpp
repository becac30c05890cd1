#include <doctest/doctest.h>

#include <array>

#include "plan/report/plan_summary.hpp"
#include "plan/report/views_json.hpp"

namespace vantage::test {
namespace {

constexpr double kFence_m = 0.1;

/// A post between a camera and what is to be seen; a fence keeps the movable camera on one side.
WorldModel post_world() {
  WorldModel world;
  world.objects.push_back({"post",
                           std::make_shared<const TriangleMesh>(
                               TriangleMesh::from_box(Box({-0.03, -0.03, 0}, {0.03, 0.03, 0.1}))),
                           {}});
  world.cameras.push_back(
      {"front",
       PinholeCamera({64, 48, 60, 60, 31.5, 23.5}, Pose::looking_at({0, -0.5, 0.2}, {0, 0, 0.05})),
       nullptr});
  return world;
}

Plan fenced_plan(const WorldModel& world, const ViewCheck& check) {
  PlanRequest request{.work_area = Box({-0.1, -0.1, 0}, {0.1, 0.1, 0.1}),
                      .intrinsics = {64, 48, 60, 60, 31.5, 23.5}};
  request.constraints.reach = Reach{{0, 0, 0}, 0, 0.35};
  request.constraints.checks = {check};
  return plan_next_view(world, request);
}

}  // namespace

TEST_CASE("plan.json says why a check rejected a candidate, and how many it rejected") {
  const WorldModel world = post_world();
  const auto on_this_side = [](const Pose& pose) { return pose.translation().x() < kFence_m; };
  const Plan plan = fenced_plan(world, view_check(on_this_side, "behind the fence"));
  const auto candidates = candidates_json(plan);
  int fenced = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const bool by_check = plan.candidates[i].rejected == InvalidReason::rejected_by_check;
    CHECK((candidates[i]["rejected"] == "behind the fence") == by_check);
    CHECK(candidates[i]["feasible"] == candidates[i]["rejected"].is_null());
    fenced += by_check;
    if (!by_check) continue;
    const auto explained = explanations_json(plan, explain_views(world, plan, std::array{int(i)}));
    CHECK(explained[0]["rejected"] == "behind the fence");
    CHECK(explained[0]["verdict"] == "rejected: behind the fence");
  }
  CHECK(fenced > 0);
  const auto rejections = rejections_json(plan);
  CHECK(rejections["behind the fence"] == fenced);
  CHECK(rejections["out of reach"] > 0);
  CHECK(rejections.begin().key() == "out of reach");  // what is tested first comes first
  const ShadowRegions regions(*plan.classified);
  CHECK(summary_of(plan, &regions, {}).find(std::to_string(fenced) + " behind the fence") !=
        std::string::npos);
}

TEST_CASE("a check that uses a built-in reason's words is counted with it") {
  const auto on_this_side = [](const Pose& pose) { return pose.translation().x() < kFence_m; };
  const Plan plan = fenced_plan(post_world(), view_check(on_this_side, "out of reach"));
  std::size_t rejected = 0;
  for (const ScoredCandidate& candidate : plan.candidates) {
    rejected += candidate.rejected != InvalidReason::none;
  }
  CHECK(rejections_json(plan) == nlohmann::ordered_json{{"out of reach", rejected}});
}

}  // namespace vantage::test
