#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "planner/scored_space.hpp"
#include "planner/wall_world.hpp"
#include "reference/random_scene.hpp"
#include "reference/random_workcell.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/planner/advanced/mesh_scorer.hpp"
#include "vantage/raycore/advanced/unobserved_space.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

using test::Random;

const Intrinsics kSmall{64, 48, 60, 60, 31.5, 23.5};
constexpr DepthRange kRange{0.05, 2};

/// A camera at the origin that looks along x and measures `depth_m` everywhere.
SeenWorld flat_world(double depth_m, const Box& work_area) {
  const PinholeCamera camera(kSmall, Pose::looking_at({0, 0, 0}, {1, 0, 0}), kRange);
  return {
      work_area, {{camera, {0, 63}, {0, 47}, std::vector<float>(4, float(depth_m))}}, WorldModel{}};
}

Score exact_score(const MeshScorer& scorer, const PinholeCamera& view) {
  const ScoreBound result = scorer.score(view);
  REQUIRE(result.exact());
  return result.score;
}

/// Pixel by pixel: what is unseen, if nothing known is before it.
struct PlainSight {
  double score = 0, pixels = 0;
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};

PlainSight plain_sight(const SeenWorld& world, const PinholeCamera& view, double power) {
  const auto seen = test::scored_space(world);
  const auto known = known_scene(world.known);
  PlainSight observation;
  for (int v = 0; v < view.intrinsics().height; ++v) {
    for (int u = 0; u < view.intrinsics().width; ++u) {
      const std::array tile{PixelTile{std::uint16_t(u / 4), std::uint16_t(v / 4)}};
      std::array<UnseenHits, 1> unseen;
      std::array<TileHits, 1> object;
      seen->first_unseen(view, tile, unseen);
      known->first_hits(view, tile, object);
      const int lane = 4 * (v % 4) + u % 4;
      const double depth_m = double(unseen[0].t[lane]), facing = double(unseen[0].facing[lane]);
      if (depth_m < view.range().near_m || depth_m > view.range().far_m) continue;
      if (double(object[0].t[lane]) <= depth_m) continue;
      observation.score += (1 - facing) * std::pow(depth_m / view.range().far_m, power);
      ++observation.pixels;
      if (facing > 0.5) continue;
      observation.left = std::min(observation.left, u),
      observation.right = std::max(observation.right, u);
      observation.top = std::min(observation.top, v),
      observation.bottom = std::max(observation.bottom, v);
    }
  }
  return observation;
}

PinholeCamera view_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
                      const Intrinsics& k = kSmall) {
  return {k, Pose::looking_at(eye, target), kRange};
}

}  // namespace

TEST_CASE("what a camera looked straight at counts by the angle at which it did") {
  const SeenWorld world = flat_world(1, Box({0.5, -0.2, -0.2}, {1.5, 0.2, 0.2}));
  for (const double power : {0.0, 6.0, 2.5}) {
    CAPTURE(power);
    const MeshScorer scorer(world, kRange, power, kSmall.width);
    // From the same place, every ray leaves what was seen at depth 1, if not at the box's sides.
    // A little narrower than the camera that measured: its outermost rays lie in the seen's sides.
    const PinholeCamera view = view_at({0, 0, 0}, {1, 0, 0}, {64, 48, 63, 63, 31.5, 23.5});
    double expected = 0;
    for (int v = 0; v < 48; ++v) {
      for (int u = 0; u < 64; ++u) {
        const double x = (u - 31.5) / 63, y = (v - 23.5) / 63;
        if (std::abs(x) > 0.2 || std::abs(y) > 0.2) continue;
        expected += (1 - 1 / std::sqrt(1 + x * x + y * y)) * std::pow(1 / kRange.far_m, power);
      }
    }
    const double score = double(exact_score(scorer, view)) * 0x1p-35;
    CHECK(std::abs(score - expected) < 1e-4 * expected + 1e-6);
  }
}

TEST_CASE("what no camera looked at counts in full: the box's faces, and along lines of sight") {
  const SeenWorld world = flat_world(1, Box({0.5, -0.2, -0.2}, {1.5, 0.2, 0.2}));
  const MeshScorer scorer(world, kRange, 0, kSmall.width);
  const PinholeCamera behind = view_at({2.5, 0, 0}, {1, 0, 0});
  const double pixels = scorer.terms(behind)[0].value;
  CHECK(pixels > 20 * 20);
  CHECK(scorer.terms(behind)[3].value == 0);  // the back face: nothing looked at it
  CHECK(double(exact_score(scorer, behind)) * 0x1p-35 == pixels);
  // A box that lies in what was seen shows nothing.
  const SeenWorld empty = flat_world(1, Box({0.5, -0.05, -0.05}, {0.9, 0.05, 0.05}));
  const MeshScorer nothing(empty, kRange, 0, kSmall.width);
  CHECK(exact_score(nothing, behind) == 0);
  CHECK(!nothing.shadow_bounds(behind));
}

TEST_CASE("known objects hide what is behind them, and count as nothing to look for") {
  SeenWorld world = flat_world(1, Box({0.5, -0.2, -0.2}, {1.5, 0.2, 0.2}));
  const PinholeCamera behind = view_at({2.5, 0, 0}, {1, 0, 0});
  const double before = MeshScorer(world, kRange, 0, 64).terms(behind)[0].value;
  world.known.objects.push_back({"screen",
                                 std::make_shared<const TriangleMesh>(
                                     TriangleMesh::from_box(Box({1.6, 0, -0.5}, {1.7, 0.5, 0.5}))),
                                 {}});
  const double after = MeshScorer(world, kRange, 0, 64).terms(behind)[0].value;
  CHECK(after < 0.6 * before);
  CHECK(after > 0.4 * before);
}

TEST_CASE("on random workcells a score is the sum over pixels, and a look tells score and bounds") {
  std::size_t with_shadow = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(20); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    MeshMethod options;
    options.visibility.step_px = 1 + int(random.below(4));
    const SeenWorld world = seen_world(test::random_workcell(seed, true),
                                       test::random_workcell_area(), StereoNoise(), options);
    const double power = std::array{0.0, 3.0, 6.0, 2.5}[seed % 4];
    const MeshScorer scorer(world, kRange, power, kSmall.width);
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector3d eye(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5),
                                random.uniform(0.02, 0.6));
      const PinholeCamera view = view_at(eye, {0, 0, random.uniform(0, 0.2)});
      const PlainSight plain = plain_sight(world, view, power);
      const Score score = exact_score(scorer, view);
      CHECK(std::abs(double(score) * 0x1p-35 - plain.score) < 1e-6 * plain.score + 1e-6);
      CHECK(scorer.terms(view)[0].value == plain.pixels);
      CHECK(scorer.upper_bound(view) >= score);
      const ShadowObservation observation = scorer.observe(view, std::nullopt);
      CHECK(observation.score == score);
      CHECK(observation.bounds.has_value() == (plain.right >= 0));
      if (observation.bounds) {
        CHECK(*observation.bounds ==
              ShadowBounds{plain.left, plain.right, plain.top, plain.bottom});
        ++with_shadow;
      }
      // Below what is needed it may be left at a bound, and is never taken for more.
      std::array results{ScoreBound{}};
      scorer.score(std::array{view}, std::array{score + 1}, results);
      CHECK(results[0].score <= score + (results[0].exact() ? 0 : score));
      scorer.score(std::array{view}, std::array{score}, results);
      CHECK(results[0] == ScoreBound{ScoreBound::Known::exact, score});
    }
  }
  CHECK(with_shadow > test::enough(50));
}

TEST_CASE("a view is scored by a small image of its own field of view") {
  const SeenWorld world = flat_world(1, Box({0.5, -0.2, -0.2}, {1.5, 0.2, 0.2}));
  const MeshScorer scorer(world, kRange, 6, 64);
  const PinholeCamera large = view_at({2.5, 0, 0}, {1, 0, 0}, {640, 480, 600, 600, 319.5, 239.5});
  const PinholeCamera same = view_at({2.5, 0, 0}, {1, 0, 0}, {64, 48, 60, 60, 31.5, 23.5});
  CHECK(exact_score(scorer, large) == exact_score(scorer, same));
  CHECK(!scorer.observe(large, std::nullopt).score);
  CHECK(scorer.observe(same, std::nullopt).score);
}

TEST_CASE(
    "what noise leaves unseen on the floor counts as seen, a box that stands there does not") {
  // A camera looks down at a floor where some depths are 8 mm too small.
  const PinholeCamera camera(kSmall, Pose::looking_at({0, 0, 1}, {0, 0, 0}), kRange);
  const Box area({-0.2, -0.2, 0}, {0.2, 0.2, 0.2});
  Random random(7);
  std::vector<float> depths(64 * 48, 1.0f);
  for (float& depth : depths) depth -= random.below(4) == 0 ? 0.008f : 0.0f;
  const auto score = [&](double opening_m) {
    WorldModel world;
    world.cameras.push_back({"above", camera, std::make_shared<const DepthImage>(64, 48, depths)});
    MeshMethod options;
    options.visibility.step_px = 1;
    options.visibility.offset_sigmas = 0;
    options.opening_m = opening_m;
    const MeshScorer scorer(seen_world(world, area, StereoNoise(), options), kRange, 6, 64);
    return double(exact_score(scorer, view_at({0.6, 0, 0.5}, {0, 0, 0.05}))) * scorer.unit();
  };
  const double false_shadow = score(0);
  CHECK(false_shadow > 0);
  CHECK(score(0.025) == 0);
  for (int v = 20; v < 28; ++v) {  // 13 cm wide, 10 cm high
    for (int u = 28; u < 36; ++u) depths[std::size_t(64 * v + u)] = 0.9f;
  }
  const double with_box = score(0), box = score(0.025);
  CHECK(box > 0.2 * false_shadow);
  CHECK(box < with_box - 0.5 * false_shadow);
}

TEST_CASE("known objects are enlarged about their middle, static structures are not") {
  WorldModel world = test::wall_world();
  world.cameras[0].depth =
      std::make_shared<const DepthImage>(64, 48, std::vector<float>(std::size_t(64 * 48), 0.5f));
  const auto shelf = std::make_shared<const TriangleMesh>(
      TriangleMesh::from_box(Box({0.2, 0, 0}, {0.3, 0.1, 0.1})));
  world.static_structures.push_back({"shelf", shelf, {}});
  world.objects[0].T_world_object = Pose::from_rotation(
      Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {0.01, 0.02, 0.03});
  const SeenWorld seen = seen_world(world, test::random_workcell_area(), StereoNoise());
  REQUIRE(seen.known.objects.size() == 1);
  const KnownObject& before = world.objects[0];
  const KnownObject& after = seen.known.objects[0];
  const Eigen::Vector3d middle = before.T_world_object * Eigen::Vector3d(0, 0, 0.09);
  for (std::size_t i = 0; i < before.mesh->vertices().size(); ++i) {
    const Eigen::Vector3d from =
        before.T_world_object * before.mesh->vertices()[i].cast<double>() - middle;
    const Eigen::Vector3d to =
        after.T_world_object * after.mesh->vertices()[i].cast<double>() - middle;
    CHECK((to - 1.2 * from).norm() < 1e-6);
  }
  CHECK(seen.known.static_structures[0].mesh == shelf);
  CHECK(seen.known.cameras.empty());
  CHECK(seen.lattices.size() == 1);
}

TEST_CASE("noise is filtered out in a hall, too, by larger voxels") {
  WorldModel world = test::wall_world();
  world.cameras[0].depth =
      std::make_shared<const DepthImage>(64, 48, std::vector<float>(std::size_t(64 * 48), 1.5f));
  const SeenWorld hall = seen_world(world, Box({-40, -40, 0}, {40, 40, 8}), StereoNoise());
  CHECK(hall.opened->geometry().voxel_count() <= 17'000'000);
  CHECK(hall.opened->count(VoxelState::shadow) > 16'000'000);
  const SeenWorld bench = seen_world(world, test::random_workcell_area(), StereoNoise());
  CHECK(bench.opened->geometry().voxel_size_m() == doctest::Approx(0.025 / 3));
}

TEST_CASE("the mesh method reports what it needs") {
  const WorldModel blind = test::wall_world();
  const Box area = test::random_workcell_area();
  test::expect_bad_input("method", "none of the 1 cameras has one",
                         [&] { (void)seen_world(blind, area, StereoNoise()); });
  const auto refused = [&](const MeshMethod& options, std::string_view part) {
    test::expect_bad_input("mesh", part, [&] { options.check(); });
  };
  refused({.opening_m = -1}, "an opening of -1 m");
  refused({.opening_m = std::nan("")}, "an opening of nan m");
  refused({.enlarge = 0.5}, "scaled by 0.5; expected 1 to 10");
  refused({.enlarge = std::nan("")}, "expected 1 to 10");
  refused({.image_width = 8}, "images of 8 pixels; expected 16 to 16384");
  refused({.shortlist = 0}, "a shortlist of 0");
  refused({.exact_views = -1}, "from -1 views on");
  refused({.shortlist_voxel_m = 0}, "in voxels of 0 m");
  const SeenWorld world = flat_world(1, area);
  const MeshScorer scorer(world, kRange, 6);
  const PinholeCamera other = view_at({1, 0, 0}, {0, 0, 0});
  const PinholeCamera far(kSmall, other.T_world_cam(), {0.05, 3});
  test::expect_bad_input("views", "expected the scorer's, 0.05 to 2 m",
                         [&] { (void)scorer.score(far); });
  test::expect_bad_input("views", "expected the scorer's",
                         [&] { (void)scorer.observe(far, std::nullopt); });
  std::array<ScoreBound, 2> results;
  test::expect_bad_input("views", "1 views, 1 scores needed and 2 results",
                         [&] { scorer.score(std::array{other}, std::array{Score(0)}, results); });
}

}  // namespace vantage
