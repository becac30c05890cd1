#include <doctest/doctest.h>

#include <cmath>

#include "reference/noisy_depth.hpp"
#include "reference/plain_classify.hpp"
#include "reference/random_boxes.hpp"
#include "reference/thesis_volume.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "volume/small_grid.hpp"

namespace vantage {
namespace {

/// Its faces lie on borders of voxels, so that no centre is near its silhouette.
test::TurnedBox aligned_box(const Eigen::Vector3d& centre) {
  return {{0.03, 0.02, 0.04}, Pose::from_translation(centre)};
}

/// What a camera measures of these boxes on a floor, before a wall.
std::shared_ptr<const DepthImage> measured(const std::vector<test::TurnedBox>& boxes,
                                           test::Random* noise = nullptr) {
  SceneBuilder truth;
  for (const test::TurnedBox& box : boxes) {
    truth.add_box(Box(-box.half, box.half), box.T_world_box);
  }
  truth.add_box(Box({-2, -2, -0.1}, {2, 2, 0}));
  truth.add_box(Box({-2, 0.6, -0.1}, {2, 0.7, 2}));
  const auto scene = truth.build();
  if (noise != nullptr) return test::noisy_depth(*scene, test::kFront, *noise);
  return std::make_shared<const DepthImage>(scene->render_depth(test::kFront));
}

}  // namespace

TEST_CASE("a wrong pose shows: as many voxels in conflict as depth sees through, by name") {
  std::uint64_t conflicts = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(8); ++seed) {
    CAPTURE(seed);
    test::Random random(seed);
    const test::TurnedBox right = aligned_box({-0.06, 0, 0.06});
    const Eigen::Vector3d truth(random.uniform(0.02, 0.08), random.uniform(-0.05, 0.05), 0.06);
    const test::TurnedBox believed{{0.03, 0.02, 0.04},
                                   Pose::from_translation({0.06, -0.02, 0.1}) * random.pose(0.02)};
    WorldModel world;
    world.objects = {test::known_box("right", right), test::known_box("wrong", believed)};
    world.cameras.push_back({"front", test::kFront, measured({right, aligned_box(truth)})});
    const GridGeometry geometry = test::small_grid();
    const auto grid = classify(world, geometry);

    const test::PlainClassifier plain(world, geometry);
    std::uint64_t of_voxels = 0, seen_through = 0, close_calls = 0;
    test::for_each_voxel(geometry, [&](const Eigen::Vector3i& voxel) {
      if (!believed.contains(geometry.centre(voxel))) return;
      ++of_voxels;
      CHECK(grid->at(voxel) == VoxelState::occupied);
      bool close_call = false;
      const bool through = plain.sees_through(world.cameras[0], voxel, close_call);
      ++(close_call ? close_calls : through ? seen_through : conflicts);
    });
    REQUIRE(seen_through > 20);
    REQUIRE(grid->report().conflicts.size() == 1);
    const ObjectConflict& conflict = grid->report().conflicts[0];
    CHECK(conflict.object == "wrong");
    CHECK(conflict.of_voxels == of_voxels);
    CHECK(conflict.voxels >= seen_through);
    CHECK(conflict.voxels <= seen_through + close_calls);
    CHECK(close_calls * 5 < seen_through);
  }
}

TEST_CASE("a correct pose is in no conflict, with clean depth and with noisy depth") {
  const test::TurnedBox box = aligned_box({0.02, 0, 0.06});
  test::Random random(1);
  for (test::Random* noise : {static_cast<test::Random*>(nullptr), &random}) {
    WorldModel world;
    world.static_structures = {test::known_box("box", box)};
    world.cameras.push_back({"front", test::kFront, measured({box}, noise)});
    const auto grid = classify(world, test::small_grid());
    CHECK(grid->report().conflicts.empty());
    CHECK(grid->report().warnings.empty());
  }
  // The measuring, not the modelling, is at work here: without the box all of it is seen through.
  WorldModel world;
  world.static_structures = {test::known_box("box", box)};
  world.cameras.push_back({"front", test::kFront, measured({})});
  const auto grid = classify(world, test::small_grid());
  REQUIRE(grid->report().conflicts.size() == 1);
  CHECK(grid->report().conflicts[0].voxels == grid->report().conflicts[0].of_voxels);
  CHECK(grid->report().conflicts[0].of_voxels == 6 * 4 * 8);
}

TEST_CASE("single pixels that see through an object are not a conflict, a missing object is one") {
  const test::TurnedBox box = aligned_box({0.02, 0, 0.06});
  DepthImage spotted = *measured({box});
  int spots = 0;
  for (int v = 0; v < spotted.height(); v += 4) {
    for (int u = 0; u < spotted.width(); u += 4, ++spots) {
      spotted.set(u, v, spotted.at(u, v) + 0.04f);
    }
  }
  REQUIRE(spots > 100);
  WorldModel world;
  world.objects = {test::known_box("box", box)};
  world.cameras.push_back(
      {"front", test::kFront, std::make_shared<const DepthImage>(std::move(spotted))});
  const GridGeometry geometry = test::small_grid();
  const test::PlainClassifier plain(world, geometry);
  std::uint64_t through = 0;
  test::for_each_voxel(geometry, [&](const Eigen::Vector3i& voxel) {
    bool close_call = false;
    through += box.contains(geometry.centre(voxel)) &&
               plain.sees_through(world.cameras[0], voxel, close_call);
  });
  REQUIRE(through > 0);  // of the box's voxels, but never many that touch each other
  CHECK(classify(world, geometry)->report().conflicts.empty());

  const test::TurnedBox small{{0.006, 0.006, 0.006}, Pose::from_translation({-0.05, 0, 0.06})};
  world.objects.push_back(test::known_box("small", small));
  const auto grid = classify(world, geometry);
  REQUIRE(grid->report().conflicts.size() == 1);
  CHECK(grid->report().conflicts[0].object == "small");
}

TEST_CASE("conflicts are listed in the order of the world model, objects first") {
  WorldModel world;
  world.static_structures = {test::known_box("z post", aligned_box({0.07, 0, 0.06}))};
  world.objects = {test::known_box("b", aligned_box({0, 0, 0.06})),
                   test::known_box("a", aligned_box({-0.07, 0, 0.06}))};
  world.cameras.push_back({"front", test::kFront, measured({})});
  const auto grid = classify(world, test::small_grid());
  std::vector<std::string> names;
  for (const ObjectConflict& conflict : grid->report().conflicts) names.push_back(conflict.object);
  CHECK(names == std::vector<std::string>{"b", "a", "z post"});
}

TEST_CASE("the surface band is max(voxel, sigmas times noise) thick and grows with distance") {
  const GridGeometry geometry =
      GridGeometry::covering(Box({-0.01, 0.2, -0.01}, {0.01, 2.6, 0.01}), 0.0025);
  const PinholeCamera camera({64, 48, 60, 60, 31.5, 23.5}, Pose::looking_at({0, 0, 0}, {0, 1, 0}),
                             {0.1, 3});
  VolumeOptions coarse, noisy;
  coarse.band_sigmas = 0;
  noisy.band_sigmas = 2, noisy.noise.subpixel_px = 0.3;
  for (const VolumeOptions& options : {VolumeOptions(), coarse, noisy}) {
    for (const float metres : {0.4f, 0.8f, 1.2f, 1.6f, 2.4f}) {
      CAPTURE(metres);
      WorldModel world;
      world.cameras.push_back(
          {"front", camera,
           std::make_shared<DepthImage>(64, 48, std::vector<float>(64 * 48, metres))});
      const auto grid = classify(world, geometry, options);
      int thickness = 0;
      for (int j = 0; j < geometry.size().y(); ++j) thickness += grid->measured({3, j, 3});
      const double band =
          std::max(0.0025, options.band_sigmas * options.noise.sigma_m(double(metres)));
      CHECK(std::abs(thickness * 0.0025 - band) <= 0.0026);
      CHECK(thickness > 0);
    }
  }
}

}  // namespace vantage
