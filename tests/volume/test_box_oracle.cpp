#include <doctest/doctest.h>

#include "reference/plain_classify.hpp"
#include "reference/random_boxes.hpp"
#include "reference/thesis_volume.hpp"
#include "vantage/volume/classify.hpp"

namespace vantage {

TEST_CASE("mesh mode equals the closed form for boxes but for centres close to a silhouette") {
  std::size_t compared = 0, close_calls = 0, unseen = 0;
  std::array<std::size_t, 4> states{};
  for (std::uint32_t seed = 100; seed < 140; ++seed) {
    CAPTURE(seed);
    const test::BoxWorld world = test::random_boxes(seed);
    const test::BoxOracle oracle(world.boxes, world.cameras);
    const auto grid = classify(world.model(), world.geometry);
    test::for_each_voxel(world.geometry, [&](const Eigen::Vector3i& voxel) {
      const test::OracleState expected = oracle.classify(world.geometry.centre(voxel));
      if (expected.close_call) {
        ++close_calls;
        return;
      }
      ++compared;
      ++states[std::size_t(expected.state)];
      CAPTURE(voxel.transpose());
      REQUIRE(grid->at(voxel) == expected.state);
      const bool is_unseen = expected.unseen && expected.state == VoxelState::shadow;
      REQUIRE(grid->unseen(voxel) == is_unseen);
      unseen += std::size_t(is_unseen);
    });
  }
  MESSAGE(compared << " voxels compared, " << close_calls << " too close to call");
  CHECK(close_calls * 200 < compared);
  CHECK(unseen > 1000);
  for (const VoxelState state : {VoxelState::free, VoxelState::occupied, VoxelState::shadow}) {
    CHECK(states[std::size_t(state)] > 1000);
  }
}

TEST_CASE("the closed form for boxes agrees with rays against triangles and solid angles") {
  std::size_t compared = 0;
  for (std::uint32_t seed = 200; seed < 206; ++seed) {
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
  CHECK(compared > 5000);
}

}  // namespace vantage
