#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <numeric>

#include "reference/plain_views.hpp"
#include "shared_views.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/planner/visible_points.hpp"
#include "vantage/planner/voxel_scorer.hpp"
#include "vantage/raycore/scene_builder.hpp"
#include "vantage/volume/classify.hpp"

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
  CHECK(bounded > test::enough(200));
}

}  // namespace vantage
