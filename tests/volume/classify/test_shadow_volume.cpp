#include <doctest/doctest.h>

#include "reference/noisy_depth.hpp"
#include "reference/random_workcell.hpp"
#include "support/expect_error.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "vantage/volume/shadow_volume.hpp"
#include "volume/same_grid.hpp"
#include "volume/small_grid.hpp"
#include "volume/volume_modes.hpp"

namespace vantage {
namespace {

/// A world, the volume that follows it, and the changes that happen to both.
class Follower {
 public:
  Follower(std::uint32_t seed, const VolumeOptions& options)
      : random_(seed),
        options_(options),
        world_(test::random_workcell(seed)),
        truth_(test::scene_with_foreign_box(world_, random_)),
        volume_(world_, test::small_grid(), options) {}

  /// A new depth image, or none, from one camera, which may have moved before.
  void change_something() {
    const std::size_t i = random_.below(std::uint32_t(world_.cameras.size()));
    DepthCamera& observer = world_.cameras[i];
    const bool moves = random_.below(3) == 0;
    if (moves) {
      const Pose pose = test::random_observer(random_).T_world_cam();
      observer.camera = observer.camera.moved_to(pose);
    }
    const bool measures = random_.below(4) != 0;
    observer.depth = measures ? test::noisy_depth(*truth_, observer.camera, random_) : nullptr;
    if (moves) {
      volume_.move_camera(i, observer.camera.T_world_cam(), observer.depth);
    } else {
      volume_.set_depth(i, observer.depth);
    }
  }

  std::shared_ptr<const StateGrid> grid() const { return volume_.grid(); }
  std::shared_ptr<const StateGrid> from_scratch() const {
    return classify(world_, test::small_grid(), options_);
  }

 private:
  test::Random random_;
  VolumeOptions options_;
  WorldModel world_;
  std::shared_ptr<const Scene> truth_;
  ShadowVolume volume_;
};

}  // namespace

TEST_CASE("after any sequence of new images and moves a volume is what starting over gives") {
  for (const VolumeOptions& options : test::all_volume_modes()) {
    for (std::uint32_t seed = 0; seed < 6; ++seed) {
      CAPTURE(seed);
      Follower follower(seed, options);
      const auto first = follower.grid(), first_from_scratch = follower.from_scratch();
      test::expect_same_grid(*first, *first_from_scratch);
      for (int step = 0; step < 10; ++step) {
        CAPTURE(step);
        follower.change_something();
        if (step % 3 == 1) continue;  // several changes between two grids
        const auto expected = follower.from_scratch();
        test::expect_same_grid(*follower.grid(), *expected);
        CHECK(follower.grid()->centres(VoxelState::shadow).x ==
              expected->centres(VoxelState::shadow).x);
      }
      test::expect_same_grid(*first, *first_from_scratch);  // grids handed out do not change
    }
  }
}

TEST_CASE("a volume without cameras is all unseen shadow but for what is known") {
  WorldModel world = test::random_workcell(2);
  world.cameras.clear();
  const auto grid = ShadowVolume(world, test::small_grid()).grid();
  CHECK(grid->count(VoxelState::free) == 0);
  CHECK(grid->count(VoxelState::occupied) > 0);
  CHECK(grid->report().outside_shadow == grid->count(VoxelState::shadow));
}

TEST_CASE("a volume refuses images and cameras that do not fit, and stays as it was") {
  const WorldModel world = test::random_workcell(3);
  ShadowVolume volume(world, test::small_grid());
  const auto before = volume.grid();
  const std::size_t none = world.cameras.size();
  const Pose pose = world.cameras[0].camera.T_world_cam();
  test::expect_bad_input("camera", std::to_string(none), [&] { volume.set_depth(none, nullptr); });
  test::expect_bad_input("camera", std::to_string(none),
                         [&] { volume.move_camera(none, pose, nullptr); });
  const auto misfit = std::make_shared<const DepthImage>(3, 4);
  test::expect_bad_input("camera 0", "3×4", [&] { volume.set_depth(0, misfit); });
  test::expect_bad_input("camera 0", "3×4", [&] {
    volume.move_camera(0, Pose::from_translation({0, 0, 1}) * pose, misfit);
  });
  test::expect_same_grid(*before, *volume.grid());
}

TEST_CASE("a volume that was told to stop stays without a grid") {
  const StopToken stop;
  stop.cancel();
  const ShadowVolume volume(test::random_workcell(1), test::small_grid(), {}, stop);
  CHECK(volume.grid() == nullptr);
}

TEST_CASE("a change that was stopped leaves no grid until it is done again") {
  const WorldModel world = test::random_workcell(1);
  const DepthCamera& camera = world.cameras[0];
  const Pose& pose = camera.camera.T_world_cam();
  const StopToken stop;
  stop.cancel();
  ShadowVolume volume(world, test::small_grid());
  const auto before = volume.grid();
  volume.set_depth(0, camera.depth, stop);
  CHECK(volume.grid() == nullptr);
  volume.set_depth(0, camera.depth);
  test::expect_same_grid(*before, *volume.grid());

  volume.move_camera(0, pose, camera.depth, stop);
  volume.set_depth(0, camera.depth);  // does not trace the rays that were left out
  CHECK(volume.grid() == nullptr);
  volume.move_camera(0, pose, camera.depth);
  test::expect_same_grid(*before, *volume.grid());
}

}  // namespace vantage
