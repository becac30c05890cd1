#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "reference/noisy_depth.hpp"
#include "reference/random_workcell.hpp"
#include "support/scene_count.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "volume/same_grid.hpp"
#include "volume/volume_modes.hpp"

namespace vantage {
namespace {

constexpr double kExactVoxel = 1.0 / 128;

/// Whole voxels of 1/128 m.
GridGeometry exact_grid(const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  const Eigen::Vector3d low(-15 * kExactVoxel, -16 * kExactVoxel, 0),
      high(17 * kExactVoxel, 15 * kExactVoxel, 0.2);
  return GridGeometry::covering(Box(low + shift, high + shift), kExactVoxel);
}

/// A random workcell with one more camera, which measures depth.
WorldModel random_world(std::uint32_t seed) {
  WorldModel world = test::random_workcell(seed);
  test::Random random(seed);
  const PinholeCamera camera = test::random_observer(random);
  const auto scene = test::scene_with_foreign_box(world, random);
  world.cameras.push_back({"last", camera, test::noisy_depth(*scene, camera, random)});
  return world;
}

/// How many voxels are shadow in `after` and were not in `before`.
std::size_t added_shadow(const StateGrid& before, const StateGrid& after) {
  std::size_t added = 0;
  test::for_each_voxel(before.geometry(), [&](const Eigen::Vector3i& voxel) {
    added += after.at(voxel) == VoxelState::shadow && before.at(voxel) != VoxelState::shadow;
  });
  return added;
}

/// How many voxels went from one state to another.
std::size_t turned(const StateGrid& before, VoxelState from, const StateGrid& after,
                   VoxelState to) {
  std::size_t count = 0;
  test::for_each_voxel(before.geometry(), [&](const Eigen::Vector3i& voxel) {
    count += before.at(voxel) == from && after.at(voxel) == to;
  });
  return count;
}

/// The pose with its translation on multiples of 2^-20 m, so that shifting it by some metres is
/// exact.
Pose on_lattice(const Pose& pose) {
  const Eigen::Vector3d t = pose.translation();
  const Eigen::Vector3d rounded = (t.array() * 0x1p20).round() * 0x1p-20;
  return Pose::from_translation(rounded - t) * pose;
}

WorldModel moved(WorldModel world, const Eigen::Vector3d& shift) {
  const Pose move = Pose::from_translation(shift);
  for (auto* list : {&world.objects, &world.static_structures}) {
    for (KnownObject& object : *list) {
      object.T_world_object = move * on_lattice(object.T_world_object);
    }
  }
  for (DepthCamera& observer : world.cameras) {
    const Pose pose = move * on_lattice(observer.camera.T_world_cam());
    observer.camera = observer.camera.moved_to(pose);
  }
  return world;
}

}  // namespace

TEST_CASE("adding a camera never adds shadow, and what is free stays free") {
  for (const VolumeOptions& options : test::all_volume_modes()) {
    std::size_t freed = 0;
    for (std::uint32_t seed = 0; seed < test::scene_count(6); ++seed) {
      CAPTURE(seed);
      WorldModel world = random_world(seed);
      const std::vector<DepthCamera> cameras = std::exchange(world.cameras, {});
      auto before = classify(world, exact_grid(), options);
      for (const DepthCamera& camera : cameras) {
        world.cameras.push_back(camera);
        const auto after = classify(world, exact_grid(), options);
        CHECK(added_shadow(*before, *after) == 0);
        // Anti-aliasing frees shadow in which the new camera may measure a surface.
        if (!options.anti_aliased()) {
          CHECK(turned(*before, VoxelState::free, *after, VoxelState::occupied) == 0);
        }
        freed += turned(*before, VoxelState::shadow, *after, VoxelState::free);
        before = after;
      }
    }
    CHECK(freed >= test::enough(10001));
  }
}

// With anti-aliasing this need not hold: the object's own voxels may become shadow, and give a
// neighbour, freed for want of shadow neighbours, its fifth.
TEST_CASE("removing a known object never turns free into shadow") {
  for (const OccluderMode mode : {OccluderMode::mesh, OccluderMode::voxels}) {
    const VolumeOptions options = test::volume_mode(mode, false);
    std::size_t freed = 0;
    for (std::uint32_t seed = 0; seed < test::scene_count(12); ++seed) {
      CAPTURE(seed);
      WorldModel world = random_world(seed);
      auto before = classify(world, exact_grid(), options);
      while (!world.objects.empty()) {
        world.objects.pop_back();
        const auto after = classify(world, exact_grid(), options);
        CHECK(turned(*before, VoxelState::free, *after, VoxelState::shadow) == 0);
        freed += turned(*before, VoxelState::shadow, *after, VoxelState::free);
        before = after;
      }
    }
    CHECK(freed >= test::enough(1001));
  }
}

TEST_CASE("three states and nothing else fill the work area in every mode") {
  for (const VolumeOptions& options : test::all_volume_modes()) {
    for (std::uint32_t seed = 0; seed < test::scene_count(6); ++seed) {
      CAPTURE(seed);
      const auto grid = classify(random_world(seed), exact_grid(), options);
      std::array<std::uint64_t, 4> counts{};
      std::uint64_t unseen = 0, stray_marks = 0;
      test::for_each_voxel(grid->geometry(), [&](const Eigen::Vector3i& voxel) {
        const VoxelState state = grid->at(voxel);
        REQUIRE(int(state) >= 0);
        REQUIRE(int(state) < 3);
        ++counts[std::size_t(state)];
        unseen += (grid->shadow_cause(voxel) == ShadowCause::outside);
        stray_marks +=
            (grid->shadow_cause(voxel) == ShadowCause::outside) && state != VoxelState::shadow;
        stray_marks += grid->measured(voxel) && state != VoxelState::occupied;
      });
      CHECK(stray_marks == 0);
      CHECK(grid->report().outside_shadow == unseen);
      for (int s = 0; s < 4; ++s) CHECK(grid->count(VoxelState(s)) == counts[std::size_t(s)]);
      CHECK(counts[0] + counts[1] + counts[2] == grid->geometry().voxel_count());
      CHECK(grid->centres(VoxelState::shadow).size() == counts[2]);
    }
  }
}

TEST_CASE("moving world, cameras and work area by whole voxels changes nothing, even far out") {
  for (const VolumeOptions& options : test::all_volume_modes()) {
    for (std::uint32_t seed = 0; seed < test::scene_count(6); ++seed) {
      CAPTURE(seed);
      const WorldModel world = random_world(seed);
      const Eigen::Vector3d nowhere = Eigen::Vector3d::Zero();
      const auto here = classify(moved(world, nowhere), exact_grid(), options);
      for (const Eigen::Vector3d& voxels : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-5, 3, 11),
                                            Eigen::Vector3d(1024, -512, 256)}) {
        CAPTURE(voxels.transpose());
        const Eigen::Vector3d shift = kExactVoxel * voxels;
        const auto there = classify(moved(world, shift), exact_grid(shift), options);
        test::expect_same_grid(*here, *there);
      }
    }
  }
}

TEST_CASE("every mode gives the same at 1, 2, 3 and 8 threads") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const WorldModel world = random_world(5);
  const GridGeometry geometry = GridGeometry::covering(test::random_workcell_area(), 0.004);
  for (const VolumeOptions& options : test::all_volume_modes()) {
    std::shared_ptr<const StateGrid> first;
    for (const int threads : {1, 2, 3, 8}) {
      CAPTURE(threads);
      tbb::task_arena arena(threads);
      const auto grid = arena.execute([&] { return classify(world, geometry, options); });
      if (first == nullptr) first = grid;
      test::expect_same_grid(*first, *grid);
      CHECK(grid->centres(VoxelState::shadow).x == first->centres(VoxelState::shadow).x);
      CHECK(grid->centres(VoxelState::shadow).z == first->centres(VoxelState::shadow).z);
    }
  }
}

}  // namespace vantage
