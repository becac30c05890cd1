#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <numbers>

#include "planner/fake_scorer.hpp"
#include "planner/small_area.hpp"
#include "support/expect_error.hpp"
#include "vantage/planner/advanced/view_search.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

const PinholeCamera kSmallCamera({64, 48, 60, 60, 31.5, 23.5}, Pose(), {0.05, 3});

/// Nothing stands there, and half of the work area is in shadow.
PlanningScene half_seen_scene() {
  WorldModel world;
  world.cameras.push_back(
      {"side", kSmallCamera.moved_to(Pose::looking_at({0, -0.5, 0.3}, {0.12, 0, 0.1})), nullptr});
  return {world, classify(world, GridGeometry::covering(test::kSmallArea, 0.02)),
          OccluderMode::mesh};
}

/// Sees shadow somewhere, as the pose's hash has it; sometimes none.
class FakeView final : public ShadowView {
 public:
  std::optional<ShadowBounds> shadow_bounds(const PinholeCamera& view) const override {
    std::uint64_t hash = test::hash_of(view.T_world_cam(), 99);
    const Intrinsics& k = view.intrinsics();
    const auto next = [&](int below) {
      const int value = int(hash % std::uint64_t(below));
      hash /= std::uint64_t(below);
      return value;
    };
    if (next(8) == 0) return std::nullopt;
    ShadowBounds b{next(k.width), next(k.width), next(k.height), next(k.height)};
    if (b.left > b.right) std::swap(b.left, b.right);
    if (b.top > b.bottom) std::swap(b.top, b.bottom);
    return b;
  }
};

struct SearchSetting {
  std::shared_ptr<test::FakeScorer> scorer;
  std::shared_ptr<const ViewValidityChecker> validity;
  std::shared_ptr<const ServoRefiner> servo;
  SearchOptions options;

  ViewSearch search() const { return {scorer, validity, servo, kSmallCamera, options}; }
};

SearchSetting setting(std::uint64_t seed, Score most, Score slack, int servo_iterations) {
  const PlanningScene scene = half_seen_scene();
  ViewConstraints constraints;
  constraints.reach = Reach{{0.3, 0, 0.2}, 0, 0.75};  // rejects some
  SearchSetting s{
      std::make_shared<test::FakeScorer>(seed, most, slack),
      std::make_shared<const ViewValidityChecker>(constraints, scene, kSmallCamera.range()),
      nullptr,
      {}};
  if (servo_iterations > 0) {
    s.servo = std::make_shared<const ServoRefiner>(std::make_shared<const FakeView>(), s.validity,
                                                   kSmallCamera, scene.middle_of_shadow(),
                                                   ServoOptions{servo_iterations, 64});
  }
  return s;
}

std::vector<ViewCandidate> some_views() {
  HalfSpheres spheres{{0.4, 0.6}, {25, 40}, {}};
  spheres.fan.rings = 1;
  return view_candidates(spheres, test::kSmallArea);
}

/// The obvious way: every step of every candidate, then sort.
std::vector<RankedView> plain_ranking(const SearchSetting& s,
                                      std::span<const ViewCandidate> views) {
  std::vector<RankedView> all;
  for (std::size_t c = 0; c < views.size(); ++c) {
    if (s.validity->check(views[c].T_world_cam) != InvalidReason::none) continue;
    std::vector<ServoStep> path = {{views[c].T_world_cam, ServoMove::start}};
    if (s.servo) path = s.servo->path(views[c].T_world_cam);
    std::optional<RankedView> best;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const Pose& pose = path[i].T_world_cam;
      double share = 1;
      if (const auto& travel = s.options.travel) {
        share = std::exp(-travel->weight_per_m * (pose.translation() - travel->from_m).norm());
      }
      const Score score = s.scorer->true_score(pose);
      const Score utility =
          Score(std::floor(double(score) * std::llround(share * 4294967296.0) / 4294967296.0));
      if (!best || utility > best->utility) best = RankedView{c, pose, int(i), score, utility};
    }
    if (best->utility > 0) all.push_back(*best);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const RankedView& a, const RankedView& b) { return a.utility > b.utility; });
  if (all.size() > std::size_t(s.options.ranked)) all.resize(std::size_t(s.options.ranked));
  return all;
}

void expect_same_ranking(const std::vector<RankedView>& a, const std::vector<RankedView>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CAPTURE(i);
    CHECK(a[i].candidate == b[i].candidate);
    CHECK(a[i].score == b[i].score);
    CHECK(a[i].utility == b[i].utility);
    CHECK(a[i].servo_iteration == b[i].servo_iteration);
    CHECK(a[i].T_world_cam.translation() == b[i].T_world_cam.translation());
    CHECK(a[i].T_world_cam.rotation() == b[i].T_world_cam.rotation());
  }
}

}  // namespace

TEST_CASE("the search ranks candidates as sorting all of them does") {
  const std::vector<ViewCandidate> views = some_views();
  std::size_t exact = 0, steps = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    const Score most = seed % 2 == 0 ? 1'000'000 : 12;  // few equals, many equals
    SearchSetting s = setting(seed, most, seed % 3 == 0 ? 0 : most / 3, seed % 4 < 2 ? 0 : 5);
    s.options.ranked = seed % 5 == 0 ? 1 : 10;
    if (seed % 7 == 0) s.options.travel = TravelCost{1.5, {0.3, 0.3, 0.3}};
    const SearchResult result = s.search().run(views);
    exact += s.scorer->exact_scores();
    expect_same_ranking(result.ranked, plain_ranking(s, views));
    CHECK(result.stopped == StopReason::none);
    CHECK(result.finished == views.size());
    for (const ViewCandidate& view : views) {
      const bool rejected = s.validity->check(view.T_world_cam) != InvalidReason::none;
      CHECK((result.candidates[std::size_t(view.id)].rejected != InvalidReason::none) == rejected);
      if (!rejected) steps += s.servo ? s.servo->path(view.T_world_cam).size() : 1;
    }
  }
  CHECK(exact < steps / 2);  // and it did not score them all
}

TEST_CASE("every score that a search reports is right, and so is every bound") {
  const std::vector<ViewCandidate> views = some_views();
  for (const int servo : {0, 4}) {
    const SearchSetting s = setting(5, 1000, 300, servo);
    const SearchResult result = s.search().run(views);
    std::size_t exact = 0, bounds = 0;
    for (std::size_t c = 0; c < views.size(); ++c) {
      const ScoredCandidate& candidate = result.candidates[c];
      if (candidate.rejected != InvalidReason::none) continue;
      Score best = 0;
      int at = 0, i = 0;
      for (const ScoredStep& step : s.search().trace(views[c])) {
        REQUIRE(step.score.exact());
        if (step.score.score > best) best = step.score.score, at = i;
        ++i;
      }
      if (candidate.score.exact()) {
        CHECK(candidate.score.score == best);
        CHECK(candidate.servo_iteration == at);
        ++exact;
      } else {
        CHECK(candidate.score.known == ScoreBound::Known::at_most);
        CHECK(candidate.score.score >= best);
        CHECK(candidate.score.score < result.ranked.back().score);
        ++bounds;
      }
    }
    CHECK(exact >= 10);
    CHECK(bounds > 10);
  }
}

TEST_CASE("a search is the same at 1, 2, 3 and 8 threads") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const std::vector<ViewCandidate> views = some_views();
  const SearchSetting s = setting(3, 10000, 4000, 3);
  std::optional<SearchResult> first;
  for (const int threads : {1, 2, 3, 8}) {
    tbb::task_arena arena(threads);
    const SearchResult result = arena.execute([&] { return s.search().run(views); });
    if (!first) first = result;
    expect_same_ranking(result.ranked, first->ranked);
    for (std::size_t c = 0; c < views.size(); ++c) {
      CHECK(result.candidates[c].score == first->candidates[c].score);  // bounds, too
    }
  }
}

TEST_CASE("views that reveal nothing are not suggested") {
  const SearchSetting s = setting(1, 0, 5, 0);
  const SearchResult result = s.search().run(some_views());
  CHECK(result.ranked.empty());
  CHECK(result.finished == result.candidates.size());
}

TEST_CASE("a search that is stopped has only what was finished") {
  const SearchSetting s = setting(2, 1000, 10, 0);
  const StopToken cancelled;
  cancelled.cancel();
  const SearchResult result = s.search().run(some_views(), cancelled);
  CHECK(result.stopped == StopReason::cancelled);
  CHECK(result.finished == 0);
  CHECK(result.ranked.empty());
}

TEST_CASE("a search refuses options that make no sense") {
  test::expect_bad_input("ranked", "found 0", [] { SearchOptions{0, {}}.check(); });
  test::expect_bad_input("travel", "weight -1", [] {
    SearchOptions{1, TravelCost{-1, {0, 0, 0}}}.check();
  });
  test::expect_bad_input("servo", "-1 iterations", [] { ServoOptions{-1, 160}.check(); });
  test::expect_bad_input("servo", "15 pixels", [] { ServoOptions{5, 15}.check(); });
  test::expect_bad_input("views", "0 views", [] { ViewSequenceOptions{0, 0, 0}.check(); });
  test::expect_bad_input("views", "1.5", [] { ViewSequenceOptions{1, 0, 1.5}.check(); });
}

}  // namespace vantage
