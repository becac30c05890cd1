#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "planner/shadow_views.hpp"
#include "planner/wall_world.hpp"
#include "reference/plain_shadow.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/planner/advanced/shadow_scorer.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

using test::Random;

constexpr double kPowers[] = {0, 3, 6, 2.5};

std::optional<ShadowBounds> bounds_of(const test::PlainShadow& plain) {
  if (!plain.bounds) return std::nullopt;
  const auto& b = *plain.bounds;
  return ShadowBounds{b[0], b[1], b[2], b[3]};
}

Score score_of(const ShadowScorer& scorer, const PinholeCamera& view) {
  const ScoreBound result = scorer.score(view);
  CHECK(result.exact());
  return result.score;
}

}  // namespace

TEST_CASE("the shadow score is that of one ray per pixel, but for close calls") {
  std::uint64_t pixels = 0, close_calls = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(24); ++seed) {
    CAPTURE(seed);
    const PlanningScene scene = test::shadow_scene(seed);
    Random random(seed);
    for (int i = 0; i < 4; ++i) {
      const double power = kPowers[i];
      const PinholeCamera view = test::shadow_view_outside(random, 61, 47);
      const ShadowScorer scorer(scene, view.range(), power);
      const auto plain = test::plain_shadow(scene.surfaces(), scene.shadow_object(), view, power);
      const double terms_pixels = scorer.terms(view)[0].value;
      CHECK(std::abs(terms_pixels - double(plain.pixels)) <= double(plain.close_calls));
      CHECK(std::abs(double(score_of(scorer, view)) - double(plain.score)) <= plain.tolerance);
      pixels += plain.pixels;
      close_calls += plain.close_calls;
    }
  }
  CHECK(pixels > test::enough(20'000));
  CHECK(close_calls * (test::kAllScenes ? 50 : 30) < pixels);
}

TEST_CASE(
    "leaving out what cannot show shadow changes nothing: packets for all tiles, to the bit") {
  std::size_t with_shadow = 0, without = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(60); ++seed) {
    CAPTURE(seed);
    const PlanningScene scene = test::shadow_scene(seed);
    Random random(seed);
    for (int i = 0; i < 40; ++i) {
      CAPTURE(i);
      const int width = 16 + int(random.below(100)), height = 12 + int(random.below(90));
      const PinholeCamera view = test::shadow_view_anywhere(random, scene, width, height);
      const double power = kPowers[i % 4];
      const ShadowScorer scorer(scene, view.range(), power);
      const auto plain = test::packet_shadow(scene.surfaces(), scene.shadow_object(), view, power);
      CHECK(score_of(scorer, view) == plain.score);
      CHECK(scorer.shadow_bounds(view) == bounds_of(plain));
      CHECK(scorer.upper_bound(view) >= plain.score);
      ++(plain.pixels > 0 ? with_shadow : without);
    }
  }
  CHECK(with_shadow > test::enough(1000));
  CHECK(without > test::enough(100));
}

TEST_CASE("covered faces of the shadow show nothing: all of its faces look the same") {
  std::uint64_t pixels = 0;
  std::size_t covered = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(40); ++seed) {
    CAPTURE(seed);
    const PlanningScene scene = test::shadow_scene(seed);
    const std::shared_ptr<const Scene> all = test::all_surfaces(seed, scene.grid());
    covered += scene.surfaces().triangle_count(scene.covered_object());
    Random random(seed);
    for (int i = 0; i < 10; ++i) {
      const PinholeCamera view = test::shadow_view_outside(random, 160, 120);
      const auto ours = test::packet_shadow(scene.surfaces(), scene.shadow_object(), view, 0);
      const auto theirs = test::packet_shadow(*all, scene.shadow_object(), view, 0);
      CHECK(ours.pixels == theirs.pixels);
      CHECK(ours.bounds == theirs.bounds);
      pixels += ours.pixels;
    }
  }
  CHECK(pixels > test::enough(100'000));
  CHECK(covered > test::enough(1000));
}

TEST_CASE("what a look expects changes nothing, and what it finds lies on the bounds") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  std::size_t looks = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(40); ++seed) {
    CAPTURE(seed);
    const PlanningScene scene = test::shadow_scene(seed);
    Random random(seed + 900);
    std::optional<ExtremePoints> former;
    for (int i = 0; i < 40; ++i) {
      CAPTURE(i);
      const PinholeCamera view = test::shadow_view_anywhere(random, scene, 80, 60);
      const ShadowScorer scorer(scene, view.range(), 0);
      const ShadowObservation observation = scorer.observe(view, std::nullopt);
      CHECK(observation.bounds == scorer.shadow_bounds(view));
      ExtremePoints nonsense;
      for (Eigen::Vector3d& point : nonsense) point = random.in_cube(0.3);
      nonsense[random.below(4)] = {kNan, 1e300, -1e300};
      nonsense[random.below(4)] = view.centre();
      CHECK(scorer.observe(view, nonsense).bounds == observation.bounds);
      CHECK(scorer.observe(view, former).bounds == observation.bounds);
      CHECK(scorer.observe(view, observation.extremes).bounds == observation.bounds);
      REQUIRE(observation.extremes.has_value() == observation.bounds.has_value());
      former = observation.extremes;
      if (!observation.bounds) continue;
      const auto pixel = [&](std::size_t border) { return *view.project((*former)[border]); };
      CHECK(pixel(0).u == doctest::Approx(observation.bounds->left).scale(1).epsilon(1e-3));
      CHECK(pixel(1).u == doctest::Approx(observation.bounds->right).scale(1).epsilon(1e-3));
      CHECK(pixel(2).v == doctest::Approx(observation.bounds->top).scale(1).epsilon(1e-3));
      CHECK(pixel(3).v == doctest::Approx(observation.bounds->bottom).scale(1).epsilon(1e-3));
      ++looks;
    }
  }
  CHECK(looks > test::enough(500));
}

TEST_CASE("a bounded shadow score is below what was needed, and never below the true one") {
  std::size_t exact = 0, bounded = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(40); ++seed) {
    CAPTURE(seed);
    const PlanningScene scene = test::shadow_scene(seed);
    Random random(seed);
    for (int i = 0; i < 20; ++i) {
      const PinholeCamera view = i % 2 == 0 ? test::shadow_view_outside(random, 120, 90)
                                            : test::shadow_view_anywhere(random, scene, 90, 120);
      const ShadowScorer scorer(scene, view.range(), kPowers[i / 2 % 4]);
      const Score truth = score_of(scorer, view);
      const Score bound = scorer.upper_bound(view);
      for (const Score needed : {Score(0), truth / 2, truth, truth + 1, truth + truth / 8,
                                 (truth + bound) / 2, bound, bound + 1}) {
        CAPTURE(needed);
        ScoreBound result;
        scorer.score({&view, 1}, {&needed, 1}, {&result, 1});
        if (result.exact()) {
          CHECK(result.score == truth);
        } else {
          CHECK(result.known == ScoreBound::Known::at_most);
          CHECK(result.score >= truth);
          CHECK(result.score < needed);
        }
        ++(result.exact() ? exact : bounded);
      }
    }
  }
  CHECK(exact > test::enough(1000));
  CHECK(bounded > test::enough(300));
}

TEST_CASE("the bound of a shadow score holds for views from anywhere" *
          doctest::test_suite("slow")) {
  std::size_t tight = 0, rough = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(60); ++seed) {
    CAPTURE(seed);
    const PlanningScene scene = test::shadow_scene(seed);
    Random random(seed + 500);
    for (int i = 0; i < 100; ++i) {
      CAPTURE(i);
      const int width = 16 + int(random.below(150));
      const PinholeCamera view = test::shadow_view_anywhere(random, scene, width, 60);
      const ShadowScorer scorer(scene, view.range(), kPowers[i % 4]);
      const Score bound = scorer.upper_bound(view), truth = score_of(scorer, view);
      CHECK(bound >= truth);
      for (const Score needed : {truth + 1, bound, 3 * bound + 1}) {
        const Score found = scorer.upper_bound_if_needed(view, needed);
        CHECK(found >= truth);
        CHECK((found == bound || found < needed));
        rough += found != bound;
      }
      tight += truth > 0 && double(bound) < 1.1 * double(truth);
    }
  }
  CHECK(tight > test::enough(300));
  CHECK(rough > test::enough(300));
}

TEST_CASE("what hides the shadow takes its part of the bound") {
  const WorldModel world = test::wall_world();
  const auto grid = classify(world, GridGeometry::covering(test::random_workcell_area(), 0.01));
  const PlanningScene scene(world, grid, OccluderMode::mesh);
  REQUIRE(scene.shadow_centres().size > 100);
  const auto from = [](const Eigen::Vector3d& eye) {
    return PinholeCamera({160, 120, 175, 175, 79.5, 59.5}, Pose::looking_at(eye, {0, 0, 0.08}),
                         {0.1, 2});
  };
  const ShadowScorer scorer(scene, {0.1, 2}, 6);
  // From where the camera stood that sees none of it, the wall is in front of most.
  const Score behind = scorer.upper_bound(from({0, 0.6, 0.15}));
  CHECK(scorer.upper_bound(from({0, -0.6, 0.15})) < behind / 4);
  CHECK(score_of(scorer, from({0, 0.6, 0.15})) > behind / 2);
}

TEST_CASE("shadow scores are the same at 1, 2, 3 and 8 threads") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const PlanningScene scene = test::shadow_scene(7);
  Random random(7);
  std::vector<PinholeCamera> views;
  for (int i = 0; i < 64; ++i) views.push_back(test::shadow_view_outside(random, 160, 120));
  const ShadowScorer scorer(scene, views[0].range(), 6);
  std::vector<Score> first;
  for (const int threads : {1, 2, 3, 8}) {
    std::vector<Score> scores(views.size());
    tbb::task_arena arena(threads);
    arena.execute([&] {
      tbb::parallel_for(std::size_t(0), views.size(), [&](std::size_t i) {
        scores[i] = scorer.score(views[i]).score + scorer.upper_bound(views[i]);
      });
    });
    if (first.empty()) first = scores;
    CHECK(scores == first);
  }
}

TEST_CASE("without shadow every score is 0, and the servo sees nothing") {
  const PlanningScene scene = test::shadow_scene(3);
  const PinholeCamera away({64, 48, 60, 60, 31.5, 23.5}, Pose::looking_at({0, 0, 3}, {0, 0, 4}),
                           {0.1, 1.5});
  const ShadowScorer scorer(scene, away.range(), 6);
  CHECK(scorer.upper_bound(away) == 0);
  CHECK(scorer.score(away) == ScoreBound{ScoreBound::Known::exact, 0});
  CHECK_FALSE(scorer.shadow_bounds(away));
  CHECK(scorer.terms(away)[2].value == 0);
}

TEST_CASE("the terms of a shadow score") {
  const PlanningScene scene = test::shadow_scene(7);
  Random random(7);
  const PinholeCamera view = test::shadow_view_outside(random, 160, 120);
  const ShadowScorer scorer(scene, view.range(), 1);
  const auto terms = scorer.terms(view);
  REQUIRE(terms.size() == 4);
  CHECK(terms[0].name == "shadow pixels");
  CHECK(terms[1].value == doctest::Approx(terms[0].value / (160 * 120)));
  CHECK(terms[2].name == "mean depth");
  CHECK(terms[2].unit == "m");
  CHECK(terms[3].name == "score");
  // At power 1 the score is the sum of the depths.
  CHECK(terms[3].value == doctest::Approx(terms[0].value * terms[2].value).epsilon(1e-6));
  CHECK(terms[3].value == doctest::Approx(double(score_of(scorer, view)) * scorer.unit()));
  CHECK(terms[0].value > (test::kAllScenes ? 100 : 50));
}

TEST_CASE("a shadow score that is stopped is unknown") {
  const PlanningScene scene = test::shadow_scene(7);
  Random random(7);
  const std::vector<PinholeCamera> views(3, test::shadow_view_outside(random, 160, 120));
  const ShadowScorer scorer(scene, views[0].range(), 6);
  const StopToken stop;
  stop.cancel();
  const std::vector<Score> needed(3);
  std::vector<ScoreBound> results(3, ScoreBound{ScoreBound::Known::exact, 5});
  scorer.score(views, needed, results, stop);
  for (const ScoreBound& result : results) CHECK(result.known == ScoreBound::Known::nothing);
}

TEST_CASE("the shadow scorer refuses what makes no sense") {
  const PlanningScene scene = test::shadow_scene(7);
  for (const double power : {-0.5, 16.5, std::numeric_limits<double>::quiet_NaN()}) {
    test::expect_bad_input("depth power", "expected a number from 0 to 16", [&] {
      ShadowScorer(scene, {0.1, 3}, power);
    });
  }
  test::expect_bad_input("depth range", "from 3 to 0.1 m", [&] {
    ShadowScorer(scene, {3, 0.1}, 6);
  });
  const ShadowScorer scorer(scene, {0.1, 3}, 6);
  Random random(7);
  const PinholeCamera view = test::shadow_view_outside(random, 16, 12);
  const std::vector<Score> needed(1);
  std::vector<ScoreBound> results(1);
  test::expect_bad_input("views", "depth range 0.1 to 1.5 m", [&] { scorer.score(view); });
  test::expect_bad_input("views", "depth range 0.1 to 1.5 m", [&] { scorer.upper_bound(view); });
  test::expect_bad_input("views", "0 views, 1 scores needed and 1 results",
                         [&] { scorer.score({}, needed, results); });
}

}  // namespace vantage
