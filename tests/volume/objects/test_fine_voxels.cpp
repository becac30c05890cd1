#include <doctest/doctest.h>

#include "reference/noisy_depth.hpp"
#include "reference/plain_classify.hpp"
#include "reference/random_workcell.hpp"
#include "reference/thesis_volume.hpp"
#include "support/scene_count.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

/// A random workcell with a bumpy block, whose silhouettes are ragged, and cameras with noise.
WorldModel bumpy_workcell(std::uint32_t seed) {
  test::Random random(seed);
  WorldModel world = test::random_workcell(seed);
  const TriangleMesh block = test::height_field_block(random, 5).scaled(0.1);
  world.static_structures.push_back({"bumps", std::make_shared<const TriangleMesh>(block),
                                     Pose::from_translation({0, 0, 0.1}) * random.pose(0.08)});
  const auto truth = test::scene_with_foreign_box(world, random);
  for (int i = 0; i < 2; ++i) {
    const PinholeCamera camera = test::random_observer(random);
    world.cameras.push_back(
        {"noisy", camera, i == 0 ? test::noisy_depth(*truth, camera, random) : nullptr});
  }
  return world;
}

}  // namespace

// Most blocks of 8³ voxels are decided at once here; the twin looks at a sample, voxel by voxel.
TEST_CASE("a sample of fine voxels, known objects and depth together, equals the plain algorithm" *
          doctest::skip(test::kSanitized)) {
  std::size_t compared = 0, close_calls = 0;
  std::array<std::size_t, 4> seen{};
  for (std::uint32_t seed = 300; seed < 300 + test::scene_count(10); ++seed) {
    CAPTURE(seed);
    const WorldModel world = bumpy_workcell(seed);
    const GridGeometry geometry = GridGeometry::covering(test::random_workcell_area(), 0.0025);
    VolumeOptions options;
    options.band_sigmas = seed % 2 == 0 ? 4 : 10;
    const auto grid = classify(world, geometry, options);
    const test::PlainClassifier plain(world, geometry, options);
    int next = 0;
    test::for_each_voxel(geometry, [&](const Eigen::Vector3i& voxel) {
      if (next++ % 199 != 0) return;
      const test::PlainState expected = plain.classify(voxel);
      if (expected.close_call) {
        ++close_calls;
        return;
      }
      ++compared;
      ++seen[std::size_t(expected.state)];
      CAPTURE(voxel.transpose());
      REQUIRE(grid->at(voxel) == expected.state);
      REQUIRE(grid->measured(voxel) == expected.measured);
    });
  }
  MESSAGE(compared << " voxels compared, " << close_calls << " too close to call");
  CHECK(close_calls * 5 < compared);
  for (const VoxelState state : {VoxelState::free, VoxelState::occupied, VoxelState::shadow}) {
    CHECK(seen[std::size_t(state)] >= test::enough(500));
  }
}

}  // namespace vantage
