#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <limits>
#include <numeric>

#include "planner/shared_views.hpp"
#include "reference/plain_views.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/planner/advanced/visible_points.hpp"
#include "vantage/planner/advanced/voxel_scorer.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

/// What is to be counted, behind what.
struct Case {
  Points points;
  std::shared_ptr<const Scene> occluders;

  static Case of_workcell(std::uint32_t seed, double voxel_size_m) {
    const WorldModel world = test::random_workcell(seed);
    const GridGeometry geometry =
        GridGeometry::covering(test::random_workcell_area(), voxel_size_m);
    const auto grid = classify(world, geometry);
    return {grid->centres(VoxelState::shadow), occluder_scene(world, *grid)};
  }
};

std::vector<ScoreBound> count(const VisiblePoints& points, std::span<const PinholeCamera> views,
                              const std::vector<Score>& needed, const StopToken& stop = {}) {
  std::vector<ScoreBound> results(views.size());
  points.count(views, needed, results, stop);
  return results;
}

/// A bound is one, and enough; what matters is exact.
void expect_bounds(const std::vector<ScoreBound>& results, const std::vector<Score>& needed,
                   const std::vector<std::uint64_t>& truth) {
  for (std::size_t i = 0; i < truth.size(); ++i) {
    CAPTURE(i);
    if (results[i].exact()) {
      REQUIRE(results[i].score == truth[i]);
    } else {
      REQUIRE(results[i].known == ScoreBound::Known::at_most);
      REQUIRE(results[i].score >= truth[i]);
      REQUIRE(results[i].score < needed[i]);
    }
  }
}

}  // namespace

TEST_CASE("shared rays and bits count what single rays count") {
  std::uint64_t seen = 0, hidden = 0, outside = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(24); ++seed) {
    CAPTURE(seed);
    const Case c = Case::of_workcell(seed, seed % 3 == 0 ? 0.006 : 0.015);
    const VisiblePoints points(c.points, c.occluders);
    CHECK(points.size() == c.points.size());
    test::Random random(seed);
    for (const std::size_t size : {1, 7, 25}) {
      const std::vector<PinholeCamera> views = test::random_shared_views(random, size);
      const std::vector<std::uint64_t> truth = test::plain_scores(c.points, *c.occluders, views);
      const std::vector<Score> all(size, 0);
      const std::vector<ScoreBound> results = count(points, views, all);
      for (std::size_t i = 0; i < size; ++i) {
        REQUIRE(results[i].exact());
        REQUIRE(results[i].score == truth[i]);
        const std::uint64_t in_view = points.count_in_view(views[i]);
        REQUIRE(points.upper_bound(views[i]) >= in_view);
        REQUIRE(in_view >= truth[i]);
        seen += truth[i], hidden += in_view - truth[i], outside += c.points.size() - in_view;
      }
      CHECK(points.visible(views[0]) == test::plain_visible(c.points, *c.occluders, views[0]));
    }
  }
  CHECK(seen > test::enough(100'000));
  CHECK(hidden > test::enough(100'000));
  CHECK(outside > test::enough(100'000));
}

TEST_CASE("what is needed decides which views are counted to the end") {
  std::size_t exact = 0, bounded = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(24); ++seed) {
    CAPTURE(seed);
    const Case c = Case::of_workcell(seed, seed % 3 == 0 ? 0.006 : 0.015);
    const VisiblePoints points(c.points, c.occluders);
    test::Random random(seed);
    for (int round = 0; round < 6; ++round) {
      const std::vector<PinholeCamera> views = test::random_shared_views(random, 1 + 5 * round);
      const std::vector<std::uint64_t> truth = test::plain_scores(c.points, *c.occluders, views);
      std::vector<Score> needed;
      for (const std::uint64_t score : truth) {
        const Score anything = random.below(std::uint32_t(c.points.size()) + 2);
        const Score choices[] = {0, score, score + 1, score - std::min<Score>(score, 1), anything};
        needed.push_back(choices[random.below(5)]);
      }
      const std::vector<ScoreBound> results = count(points, views, needed);
      expect_bounds(results, needed, truth);
      for (const ScoreBound& result : results) ++(result.exact() ? exact : bounded);
    }
  }
  CHECK(exact > test::enough(300));
  CHECK(bounded > test::enough(100));
}

TEST_CASE("counts and bounds are the same at 1, 2, 3 and 8 threads") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const Case c = Case::of_workcell(3, 0.006);
  const VisiblePoints points(c.points, c.occluders);
  test::Random random(5);
  std::vector<std::vector<PinholeCamera>> places;
  std::vector<std::vector<Score>> needed;
  for (std::size_t i = 0; i < 40; ++i) {
    places.push_back(test::random_shared_views(random, 9));
    needed.emplace_back(9, i % 2 == 0 ? 0 : c.points.size() / 2);
  }
  std::vector<std::vector<ScoreBound>> first;
  for (const int threads : {1, 2, 3, 8}) {
    CAPTURE(threads);
    std::vector<std::vector<ScoreBound>> results(places.size());
    tbb::task_arena arena(threads);
    arena.execute([&] {
      tbb::parallel_for(std::size_t(0), places.size(),
                        [&](std::size_t i) { results[i] = count(points, places[i], needed[i]); });
    });
    if (first.empty()) first = results;
    CHECK(results == first);
  }
}

TEST_CASE("a call that is stopped knows nothing, or the truth") {
  const Case c = Case::of_workcell(3, 0.003);
  const VisiblePoints points(c.points, c.occluders);
  test::Random random(7);
  const std::vector<PinholeCamera> views = test::random_shared_views(random, 9);
  const std::vector<Score> all(9, 0);
  const std::vector<ScoreBound> truth = count(points, views, all);

  const StopToken cancelled;
  cancelled.cancel();
  for (const ScoreBound& result : count(points, views, all, cancelled)) {
    CHECK((result == ScoreBound{} || result == ScoreBound{ScoreBound::Known::exact, 0}));
  }
  for (const int us : {20, 100, 500}) {
    const StopToken stop =
        StopToken::with_deadline(StopToken::Clock::now() + std::chrono::microseconds(us));
    const std::vector<ScoreBound> results = count(points, views, all, stop);
    for (std::size_t i = 0; i < views.size(); ++i) {
      CHECK((results[i] == ScoreBound{} || results[i] == truth[i]));
    }
  }
}

TEST_CASE("no points, one point, and views of nothing") {
  SceneBuilder builder;
  builder.add_box(Box({-0.1, -0.1, 0}, {0.1, 0.1, 0.2}));
  const std::shared_ptr<const Scene> box = builder.build();
  const auto view = [](const Eigen::Vector3d& eye, const Eigen::Vector3d& target, double far_m) {
    return PinholeCamera(test::kSmallImage, Pose::looking_at(eye, target), {0.1, far_m});
  };
  const PinholeCamera front = view({1, 0, 0.1}, {0, 0, 0.1}, 3);

  const VisiblePoints none(Points(), box);
  CHECK(none.size() == 0);
  CHECK(none.upper_bound(front) == 0);
  CHECK(none.visible(front).empty());
  CHECK(count(none, {&front, 1}, {0}).front() == ScoreBound{ScoreBound::Known::exact, 0});

  Points one;
  one.push_back({0.11f, 0, 0.1f});
  const VisiblePoints before(one, box);
  CHECK(before.upper_bound(front) == 1);
  CHECK(before.visible(front) == std::vector<std::uint8_t>{1});
  CHECK(count(before, {&front, 1}, {1}).front() == ScoreBound{ScoreBound::Known::exact, 1});
  const ScoreBound hopeless = count(before, {&front, 1}, {2}).front();
  CHECK(hopeless == ScoreBound{ScoreBound::Known::at_most, 1});
  for (const PinholeCamera& blind :
       {view({1, 0, 0.1}, {2, 0, 0.1}, 3), view({1, 0, 0.1}, {0, 0, 0.1}, 0.5),
        view({1, 0, 0.1}, {0.9, 0.2, 0.1}, 3)}) {
    CHECK(before.upper_bound(blind) == 0);
    CHECK(count(before, {&blind, 1}, {1}).front() == ScoreBound{ScoreBound::Known::exact, 0});
  }

  Points inside;
  for (int i = 0; i < 100; ++i) inside.push_back({0.001f * float(i), 0, 0.1f});
  const VisiblePoints hidden(inside, box);
  CHECK(hidden.upper_bound(front) == 100);
  CHECK(count(hidden, {&front, 1}, {0}).front() == ScoreBound{ScoreBound::Known::exact, 0});
  const ScoreBound enough = count(hidden, {&front, 1}, {50}).front();
  CHECK(enough.known == ScoreBound::Known::at_most);
  CHECK(enough.score < 50);
}

TEST_CASE("counting refuses spans that differ, views that share no centre, points that are none") {
  const Case c = Case::of_workcell(1, 0.02);
  const VisiblePoints points(c.points, c.occluders);
  test::Random random(1);
  std::vector<PinholeCamera> views = test::random_shared_views(random, 2);
  test::expect_bad_input("views", "2 views, 1 needed scores", [&] { count(points, views, {0}); });
  views.push_back(test::random_shared_views(random, 1).front());
  test::expect_bad_input("views", "the centre of view 2 differs", [&] {
    count(points, views, {0, 0, 0});
  });
  Points bad = c.points;
  bad.set(3, {0, std::numeric_limits<float>::quiet_NaN(), 0});
  test::expect_bad_input("point 3", "nan", [&] { VisiblePoints(bad, c.occluders); });
}

TEST_CASE("the voxel method's terms add up, and what it reveals is what it scores") {
  for (std::uint32_t seed = 0; seed < test::scene_count(6); ++seed) {
    CAPTURE(seed);
    const WorldModel world = test::random_workcell(seed);
    const auto grid = classify(world, GridGeometry::covering(test::random_workcell_area(), 0.01));
    const VoxelScorer scorer(PlanningScene(world, grid, OccluderMode::mesh));
    test::Random random(seed);
    const PinholeCamera view = test::random_shared_views(random, 1).front();
    const std::vector<ScoreTerm> terms = scorer.terms(view);
    REQUIRE(terms.size() == 5);
    const Score score = scorer.ViewScorer::score(view).score;
    const std::vector<std::uint8_t> revealed = scorer.revealed(view);
    CHECK(std::accumulate(revealed.begin(), revealed.end(), Score(0)) == score);
    CHECK(terms[0].value + terms[1].value == double(grid->count(VoxelState::shadow)));
    CHECK(terms[1].value - terms[2].value == double(score));
    CHECK(terms.back().value == double(score) * scorer.unit());
    CHECK(terms.back().unit == scorer.unit_name());
  }
}

}  // namespace vantage
