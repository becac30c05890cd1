#include <doctest/doctest.h>

#include "reference/random_boxes.hpp"
#include "reference/thesis_volume.hpp"
#include "support/scene_count.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "volume/volume_modes.hpp"

namespace vantage {
namespace {

/// Voxels compared so far, over all scenes.
struct TwinTally {
  std::size_t scenes = 0, compared = 0, close_calls = 0, unseen = 0;
  std::array<std::size_t, 4> states{};
};

/// Both volumes must agree on every voxel that is not too close to call.
void compare(const StateGrid& grid, const test::ThesisVolume& thesis, TwinTally& tally) {
  test::for_each_voxel(thesis.geometry, [&](const Eigen::Vector3i& voxel) {
    const std::size_t i = thesis.index(voxel);
    if (thesis.close_call[i]) {
      ++tally.close_calls;
      return;
    }
    ++tally.compared;
    ++tally.states[std::size_t(thesis.labels[i])];
    tally.unseen += std::size_t(thesis.unseen[i]);
    CAPTURE(voxel.transpose());
    REQUIRE(grid.at(voxel) == thesis.labels[i]);
    REQUIRE((grid.shadow_cause(voxel) == ShadowCause::outside) == bool(thesis.unseen[i]));
  });
  ++tally.scenes;
}

/// `world_of(seed)` makes a scene.
template <class WorldOf>
TwinTally compare_scenes(std::size_t scenes, bool anti_alias, const WorldOf& world_of) {
  TwinTally tally;
  const VolumeOptions options = test::volume_mode(OccluderMode::voxels, anti_alias);
  for (std::uint32_t seed = 0; tally.scenes < scenes; ++seed) {
    REQUIRE(seed < 4 * scenes + 20);
    CAPTURE(seed);
    const test::BoxWorld world = world_of(seed);
    bool close_call = false;  // one voxel that might be solid changes the shadow of others
    const std::vector<char> solid = test::solid_voxels(world.boxes, world.geometry, close_call);
    if (close_call) continue;
    const auto grid = classify(world.model(), world.geometry, options);
    compare(*grid, test::thesis_volume(world.geometry, solid, world.cameras, anti_alias), tally);
  }
  return tally;
}

void expect_enough(const TwinTally& tally) {
  MESSAGE(tally.compared << " voxels compared, " << tally.close_calls << " too close to call");
  CHECK(tally.close_calls * 100 < tally.compared);
  for (const VoxelState state : {VoxelState::free, VoxelState::occupied, VoxelState::shadow}) {
    CHECK(tally.states[std::size_t(state)] >= test::enough(1000));
  }
}

}  // namespace

TEST_CASE("voxels mode equals the thesis' algorithm voxel for voxel") {
  const TwinTally tally = compare_scenes(test::scene_count(32), false,
                                         [](auto seed) { return test::random_boxes(seed); });
  expect_enough(tally);
  CHECK(tally.unseen >= test::enough(1000));
}

TEST_CASE("voxels mode with anti-aliasing equals the thesis' algorithm voxel for voxel") {
  expect_enough(compare_scenes(test::scene_count(32), true,
                               [](auto seed) { return test::random_boxes(seed); }));
}

TEST_CASE("voxels mode equals the thesis' algorithm where voxels are fine" *
          doctest::skip(test::kSanitized)) {
  expect_enough(compare_scenes(test::scene_count(2), false,
                               [](auto seed) { return test::random_boxes(seed, 0.005); }));
  expect_enough(compare_scenes(test::scene_count(4), false,
                               [](auto seed) { return test::random_rods(seed, 0.005); }));
}

TEST_CASE("voxels mode equals the thesis' algorithm along axes, edges and corners of voxels" *
          doctest::skip(test::kSanitized)) {
  expect_enough(compare_scenes(test::scene_count(60), false,
                               [](auto seed) { return test::random_lattice_boxes(seed); }));
  expect_enough(compare_scenes(test::scene_count(3), false,
                               [](auto seed) { return test::random_lattice_boxes(seed, 4); }));
}

TEST_CASE("anti-aliasing is on by default where voxels hide, and off where meshes do") {
  const test::BoxWorld world = test::random_boxes(1);
  const auto shadow = [&](OccluderMode mode, std::optional<bool> anti_alias) {
    const VolumeOptions options = test::volume_mode(mode, anti_alias);
    return classify(world.model(), world.geometry, options)->count(VoxelState::shadow);
  };
  CHECK(shadow(OccluderMode::voxels, {}) == shadow(OccluderMode::voxels, true));
  CHECK(shadow(OccluderMode::voxels, {}) < shadow(OccluderMode::voxels, false));
  CHECK(shadow(OccluderMode::mesh, {}) == shadow(OccluderMode::mesh, false));
  CHECK(shadow(OccluderMode::mesh, {}) > shadow(OccluderMode::mesh, true));
}

TEST_CASE("anti-aliasing does in both modes what the thesis prints, and says how much it removes") {
  for (const OccluderMode mode : {OccluderMode::mesh, OccluderMode::voxels}) {
    for (std::uint32_t seed = 0; seed < test::scene_count(8); ++seed) {
      CAPTURE(seed);
      const test::BoxWorld world = test::random_boxes(seed);
      const WorldModel model = world.model();
      const auto plain = classify(model, world.geometry, test::volume_mode(mode, false));
      const auto smooth = classify(model, world.geometry, test::volume_mode(mode, true));

      test::ThesisVolume expected{world.geometry, {}, {}, {}};
      test::for_each_voxel(world.geometry, [&](const Eigen::Vector3i& voxel) {
        expected.labels.push_back(plain->at(voxel));
      });
      expected.close_call.resize(expected.labels.size());
      test::thesis_anti_alias(expected);
      test::for_each_voxel(world.geometry, [&](const Eigen::Vector3i& voxel) {
        CAPTURE(voxel.transpose());
        const VoxelState state = expected.labels[expected.index(voxel)];
        REQUIRE(smooth->at(voxel) == state);
        REQUIRE(
            (smooth->shadow_cause(voxel) == ShadowCause::outside) ==
            ((plain->shadow_cause(voxel) == ShadowCause::outside) && state == VoxelState::shadow));
      });
      const std::uint64_t removed =
          plain->count(VoxelState::shadow) - expected.count(VoxelState::shadow);
      CHECK(plain->report().aliased_shadow == removed);
      CHECK(smooth->report().aliased_shadow == removed);
      CHECK(smooth->count(VoxelState::shadow) == expected.count(VoxelState::shadow));
    }
  }
}

}  // namespace vantage
