#include <doctest/doctest.h>

#include <algorithm>

#include "planner/wall_world.hpp"
#include "reference/random_workcell.hpp"
#include "support/scene_count.hpp"

namespace vantage {
namespace {

struct PlainRank {
  std::size_t candidate;
  int iteration;
  Score score;
};

/// Every servo iteration of every candidate, scored in full.
std::vector<PlainRank> score_everything(const WorldModel& world, const Plan& plan) {
  std::vector<PlainRank> all;
  for (std::size_t c = 0; c < plan.candidates.size(); ++c) {
    const ViewExplanation view = explain_view(world, plan, plan.candidates[c].view.id);
    CHECK((view.rejected == InvalidReason::none) ==
          (plan.candidates[c].rejected == InvalidReason::none));
    PlainRank best{c, 0, 0};
    for (std::size_t i = 0; i < view.trace.size(); ++i) {
      REQUIRE(view.trace[i].score.exact());
      if (view.trace[i].score.score > best.score) best = {c, int(i), view.trace[i].score.score};
    }
    if (best.score > 0) all.push_back(best);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const PlainRank& a, const PlainRank& b) { return a.score > b.score; });
  return all;
}

}  // namespace

TEST_CASE("on random workcells a plan's top ten are those of scoring everything, by every method" *
          doctest::test_suite("slow")) {
  std::size_t left_out = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(3); ++seed) {
    for (const std::string method : {"voxel", "shadow", "light", "mesh"}) {
      CAPTURE(seed);
      CAPTURE(method);
      const WorldModel world = test::random_workcell(seed, method == "mesh");
      PlanRequest request = test::small_request();
      request.voxel_size_m = 0.02;
      request.method = method_named(method);
      const double power = seed % 2 == 0 ? 6 : 0;
      if (auto* const shadow = std::get_if<ShadowMethod>(&request.method)) {
        shadow->depth_power = power;
      } else if (auto* const mesh = std::get_if<MeshMethod>(&request.method)) {
        mesh->depth_power = power;
      }
      request.polish.views = 0;
      request.servo.iterations = seed % 3 == 0 ? 0 : 3;
      request.candidates = HalfSpheres{{0.35, 0.5}, {9}, {1, 0.3}};
      const Plan plan = plan_next_view(world, request);
      const std::vector<PlainRank> plain = score_everything(world, plan);
      REQUIRE(plan.ranked.size() == std::min<std::size_t>(10, plain.size()));
      for (std::size_t i = 0; i < plan.ranked.size(); ++i) {
        CAPTURE(i);
        CHECK(plan.ranked[i].candidate == plain[i].candidate);
        CHECK(plan.ranked[i].score == plain[i].score);
        CHECK(plan.ranked[i].servo_iteration == plain[i].iteration);
      }
      left_out += std::size_t(std::count_if(
          plan.candidates.begin(), plan.candidates.end(), [](const ScoredCandidate& candidate) {
            return candidate.score.known == ScoreBound::Known::at_most;
          }));
    }
  }
  CHECK(left_out >= test::enough(50));  // it did leave something out
}

}  // namespace vantage
