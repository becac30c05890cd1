#include <doctest/doctest.h>

#include "reference/plain_classify.hpp"
#include "reference/random_boxes.hpp"
#include "reference/thesis_volume.hpp"
#include "support/scene_count.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {

namespace {

/// Voxels compared so far, over all scenes.
struct OracleTally {
  std::size_t compared = 0, close_calls = 0, unseen = 0;
  std::array<std::size_t, 4> states{};
};

/// Compares one voxel in `every`.
void compare_with_oracle(const test::BoxWorld& world, int every, OracleTally& tally) {
  const test::BoxOracle oracle(world.boxes, world.cameras);
  const auto grid = classify(world.model(), world.geometry);
  int next = 0;
  test::for_each_voxel(world.geometry, [&](const Eigen::Vector3i& voxel) {
    if (next++ % every != 0) return;
    const test::OracleState expected = oracle.classify(world.geometry.centre(voxel));
    if (expected.close_call) {
      ++tally.close_calls;
      return;
    }
    ++tally.compared;
    ++tally.states[std::size_t(expected.state)];
    CAPTURE(voxel.transpose());
    REQUIRE(grid->at(voxel) == expected.state);
    const bool unseen = expected.unseen && expected.state == VoxelState::shadow;
    REQUIRE((grid->shadow_cause(voxel) == ShadowCause::outside) == unseen);
    tally.unseen += std::size_t(unseen);
  });
}

void expect_enough(const OracleTally& tally) {
  MESSAGE(tally.compared << " voxels compared, " << tally.close_calls << " too close to call");
  CHECK(tally.close_calls * 50 < tally.compared);
  CHECK(tally.unseen >= test::enough(300));
  for (const VoxelState state : {VoxelState::free, VoxelState::occupied, VoxelState::shadow}) {
    CHECK(tally.states[std::size_t(state)] >= test::enough(1000));
  }
}

}  // namespace

TEST_CASE("mesh mode equals the closed form for boxes but for centres close to a silhouette") {
  OracleTally tally;
  for (std::uint32_t seed = 100; seed < 100 + test::scene_count(40); ++seed) {
    CAPTURE(seed);
    compare_with_oracle(test::random_boxes(seed), 1, tally);
  }
  expect_enough(tally);
}

// Finer than the objects by far, so that most blocks of 8³ voxels are decided at once.
TEST_CASE("mesh mode equals the closed form where voxels are fine" *
          doctest::skip(test::kSanitized)) {
  OracleTally tally;
  for (std::uint32_t seed = 140; seed < 140 + test::scene_count(8); ++seed) {
    CAPTURE(seed);
    compare_with_oracle(test::random_boxes(seed, 0.003), 3, tally);
  }
  expect_enough(tally);
}

TEST_CASE("mesh mode equals the closed form for thin rods and plates in fine voxels" *
          doctest::skip(test::kSanitized)) {
  OracleTally tally;
  for (std::uint32_t seed = 150; seed < 150 + test::scene_count(8); ++seed) {
    CAPTURE(seed);
    compare_with_oracle(test::random_rods(seed, 0.003), 3, tally);
  }
  expect_enough(tally);
}

TEST_CASE("mesh mode equals the closed form for lines of sight along axes and past aligned faces") {
  OracleTally tally;
  for (std::uint32_t seed = 0; seed < test::scene_count(60); ++seed) {
    CAPTURE(seed);
    compare_with_oracle(test::random_lattice_boxes(seed), 1, tally);
  }
  expect_enough(tally);
}

TEST_CASE("the closed form for boxes agrees with rays against triangles and solid angles") {
  std::size_t compared = 0;
  for (std::uint32_t seed = 200; seed < 200 + test::scene_count(6); ++seed) {
    CAPTURE(seed);
    const test::BoxWorld world = test::random_boxes(seed);
    const test::BoxOracle oracle(world.boxes, world.cameras);
    const WorldModel model = world.model();
    const test::PlainClassifier triangles(model, world.geometry);
    test::for_each_voxel(world.geometry, [&](const Eigen::Vector3i& voxel) {
      if ((voxel.x() + voxel.y() + voxel.z()) % 5 != 0) return;  // it is slow
      const test::OracleState closed_form = oracle.classify(world.geometry.centre(voxel));
      const test::PlainState plain = triangles.classify(voxel);
      if (closed_form.close_call || plain.close_call) return;
      ++compared;
      CAPTURE(voxel.transpose());
      REQUIRE(closed_form.state == plain.state);
    });
  }
  CHECK(compared >= test::enough(5001));
}

}  // namespace vantage
