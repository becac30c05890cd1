#include <doctest/doctest.h>

#include <cmath>

#include "planner/shared_views.hpp"
#include "reference/plain_expected_gain.hpp"
#include "reference/random_workcell.hpp"
#include "support/scene_count.hpp"
#include "vantage/planner/advanced/expected_scorer.hpp"
#include "vantage/planner/advanced/voxel_scorer.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

constexpr Score kCertain = 255;

std::shared_ptr<const StateGrid> grid_of(const WorldModel& world, const VolumeOptions& volume) {
  return classify(world, GridGeometry::covering(test::random_workcell_area(), 0.026), volume);
}

/// A board across x in the middle of the work area that one camera sees from -y, and maybe a floor
/// and a box that no model knows; the camera measured all of it.
struct BoardScene {
  bool floor = true, unknown_box = false;
  Box area{{-0.15, -0.15, 0}, {0.15, 0.25, 0.2}};
  VolumeOptions volume{.noise = {.subpixel_px = 0.02}};

  TriangleMesh board() const {
    return TriangleMesh::from_box(Box({-0.1, -0.02, 0}, {0.1, 0.0, 0.15}));
  }
  WorldModel world() const {
    WorldModel world;
    world.objects.push_back({"board", std::make_shared<const TriangleMesh>(board()), {}});
    SceneBuilder truth;
    truth.add_mesh(board());
    if (unknown_box) truth.add_box(Box({-0.13, -0.1, 0}, {-0.05, -0.03, 0.08}));
    if (floor) truth.add_box(Box({-2, -2, -0.02}, {2, 2, -0.001}));
    const PinholeCamera camera({320, 240, 300, 300, 159.5, 119.5},
                               Pose::looking_at({0, -0.7, 0.4}, {0, 0, 0.05}), {0.1, 3});
    world.cameras.push_back(
        {"front", camera, std::make_shared<const DepthImage>(truth.build()->render_depth(camera))});
    return world;
  }
  PlanningScene scene(const WorldModel& world) const {
    return {world, classify(world, GridGeometry::covering(area, 0.01), volume), OccluderMode::mesh};
  }
  PinholeCamera view_from(const Eigen::Vector3d& eye) const {
    return {{320, 240, 300, 300, 159.5, 119.5}, Pose::looking_at(eye, {0, 0.05, 0.05}), {0.1, 3}};
  }
};

double share_expected(const BoardScene& cell, const PinholeCamera& view,
                      const ExpectedGainOptions& options = {}) {
  const WorldModel world = cell.world();
  const PlanningScene scene = cell.scene(world);
  const ExpectedScorer expected(scene, world, cell.volume, options);
  const double bound_m3 = double(VoxelScorer(scene).ViewScorer::score(view).score) *
                          scene.grid().geometry().voxel_volume_m3();
  REQUIRE(bound_m3 > 1e-5);
  return expected.estimate(view).expected_m3 / bound_m3;
}

}  // namespace

TEST_CASE("with an ideal sensor and nothing unknown, the expected gain is the bound") {
  for (std::uint32_t seed = 0; seed < test::scene_count(40); ++seed) {
    CAPTURE(seed);
    const WorldModel world = test::random_workcell(seed);
    const PlanningScene scene(world, grid_of(world, {}), OccluderMode::mesh);
    const ExpectedScorer expected(scene, world, {}, {StereoSensor::ideal(), 0});
    const VoxelScorer bound(scene);
    test::Random random(seed);
    for (const PinholeCamera& view : test::random_shared_views(random, 4)) {
      const Score voxels = bound.ViewScorer::score(view).score;
      CHECK(expected.ViewScorer::score(view).score == kCertain * voxels);
      const GainEstimate gain = expected.estimate(view);
      CHECK(gain.low_m3 == gain.high_m3);
      CHECK(gain.expected_m3 == doctest::Approx(double(voxels) * bound.unit()));
    }
  }
}

TEST_CASE("the expected gain equals the plain computation, ray by ray and voxel by voxel") {
  std::size_t weighed = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(24); ++seed) {
    CAPTURE(seed);
    const WorldModel world = test::random_workcell(seed, seed % 2 == 0);
    const VolumeOptions volume{.noise = {.subpixel_px = seed % 3 == 0 ? 0.0 : 0.08}};
    const PlanningScene scene(world, grid_of(world, volume), OccluderMode::mesh);
    ExpectedGainOptions options;
    options.unknown_depth = seed % 5 == 0 ? 0 : 0.8;
    const ExpectedScorer expected(scene, world, volume, options);
    const test::PlainExpectedGain plain(scene, world, volume, options);
    test::Random random(seed);
    for (const PinholeCamera& view : test::random_shared_views(random, 2)) {
      const double fast = double(expected.ViewScorer::score(view).score) / double(kCertain);
      const double slow = plain.voxels(view);
      REQUIRE(plain.voxels_in_sight(view) <= 384);
      // Rays that graze edges may go either way in float and double.
      CHECK(fast == doctest::Approx(slow).epsilon(0.01).scale(100));
      weighed += fast > 20 && fast < 0.95 * double(plain.voxels_in_sight(view));
    }
  }
  CHECK(weighed >= test::enough(10));  // views that are not all certain
}

TEST_CASE("bounds of expected gains hold, and what is needed decides what is looked at") {
  std::size_t left_out = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(40); ++seed) {
    CAPTURE(seed);
    const WorldModel world = test::random_workcell(seed, true);
    const PlanningScene scene(world, grid_of(world, {}), OccluderMode::mesh);
    const ExpectedScorer expected(scene, world, {}, {});
    test::Random random(seed);
    const auto views = test::random_shared_views(random, 6);
    std::vector<ScoreBound> exact(views.size()), results(views.size());
    expected.score(views, std::vector<Score>(views.size(), 0), exact);
    for (std::size_t i = 0; i < views.size(); ++i) {
      CHECK(exact[i].exact());
      CHECK(exact[i].score <= expected.upper_bound(views[i]));
      CHECK(exact[i].score == expected.ViewScorer::score(views[i]).score);
    }
    std::vector<Score> needed;
    for (const ScoreBound& score : exact) needed.push_back(score.score * 3 / 2 + random.below(999));
    expected.score(views, needed, results);
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (results[i].exact()) {
        CHECK(results[i].score == exact[i].score);
      } else {
        CHECK(results[i].score >= exact[i].score);
        CHECK(results[i].score < needed[i]);
        ++left_out;
      }
    }
  }
  CHECK(left_out >= test::enough(10));
}

TEST_CASE("light has to come back: with a floor that is measured, not into the void") {
  BoardScene cell;
  const PinholeCamera steep = cell.view_from({0, 0.5, 0.5});
  CHECK(share_expected(cell, steep) > 0.85);
  cell.floor = false;
  CHECK(share_expected(cell, steep) < 0.3);
  CHECK(share_expected(cell, steep, {StereoSensor::ideal(), 0}) == doctest::Approx(1));
}

TEST_CASE("what is behind the front of an unknown thing is probably inside of it") {
  BoardScene cell;
  const PinholeCamera view = cell.view_from({-0.3, 0.4, 0.5});
  const double without = share_expected(cell, view);
  cell.unknown_box = true;
  const double with = share_expected(cell, view);
  CHECK(with < 0.97 * without);
  CHECK(share_expected(cell, view, {{}, 0}) > with);
  // The deeper unknown things are, the less is expected.
  CHECK(share_expected(cell, view, {{}, 2}) < with);
}

TEST_CASE("a second imager and a projector that are blocked, and flat angles, cost readings") {
  const BoardScene cell;
  const PinholeCamera low = cell.view_from({0.4, 0.3, 0.03});
  StereoSensor single;
  single.second_imager = single.projector = false;
  CHECK(share_expected(cell, low, {single, 0.8}) >= share_expected(cell, low));
  StereoSensor all_angles;
  all_angles.max_incidence_rad = 1.57;
  CHECK(share_expected(cell, low, {all_angles, 0.8}) > share_expected(cell, low));
}

TEST_CASE("options of the expected gain that make no sense are refused") {
  CHECK_THROWS_AS((ExpectedGainOptions{{}, -1}.check()), Error);
  CHECK_THROWS_AS((ExpectedGainOptions{{}, std::nan("")}.check()), Error);
  StereoSensor sensor;
  sensor.border_px = -1;
  CHECK_THROWS_AS((ExpectedGainOptions{sensor, 1}.check()), Error);
}

}  // namespace vantage
