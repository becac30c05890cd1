#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "grid/state_grid_impl.hpp"
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

/// The same voxels in the same nodes of the trees: files of both are the same to the byte.
void expect_same_trees(const StateGrid& a, const StateGrid& b) {
  const auto &x = a.impl(), &y = b.impl();
  for (const auto& [one, other] :
       {std::pair(&x.occupied, &y.occupied), std::pair(&x.measured, &y.measured),
        std::pair(&x.shadow, &y.shadow), std::pair(&x.unmeasured, &y.unmeasured),
        std::pair(&x.outside, &y.outside)}) {
    CHECK(one->hasSameTopology(*other));
    CHECK(one->leafCount() == other->leafCount());
    CHECK(one->nonLeafCount() == other->nonLeafCount());
    CHECK(one->activeTileCount() == other->activeTileCount());
  }
}

/// A world, the volume that follows it, and the changes that happen to both.
class Follower {
 public:
  Follower(std::uint32_t seed, const VolumeOptions& options)
      : random_(seed),
        options_(options),
        world_(test::random_workcell(seed)),
        truth_(test::scene_with_foreign_box(world_, random_)),
        volume_(world_, test::small_grid(), options) {
    for (const KnownObject& object : world_.objects) meshes_.push_back(object.mesh);
    // Copies of a mesh with as many triangles are instances of it; an open mesh has no inside.
    meshes_.push_back(std::make_shared<const TriangleMesh>(test::icosphere(0.04, 3)));
    meshes_.push_back(std::make_shared<const TriangleMesh>(
        std::vector<Eigen::Vector3f>{{0, 0, 0}, {0.05f, 0, 0}, {0, 0.05f, 0}},
        std::vector<Triangle>{{0, 1, 2}}));
    meshes_.push_back(std::make_shared<const TriangleMesh>());
  }

  /// One change of any kind.
  void change_something() {
    switch (random_.below(6)) {
      case 0:
        return add_camera();
      case 1:
        return remove_camera();
      case 2:
        return change_objects();
      default:
        return change_camera();
    }
  }

  /// A new depth image, or none, from one camera, which may have moved before.
  void change_camera() {
    if (world_.cameras.empty()) return;
    const std::size_t i = random_.below(std::uint32_t(world_.cameras.size()));
    DepthCamera& observer = world_.cameras[i];
    const bool moves = random_.below(3) == 0;
    if (moves) {
      const Pose pose = test::random_observer(random_).T_world_cam();
      observer.camera = observer.camera.moved_to(pose);
    }
    observer.depth = measured_by(observer.camera);
    if (moves) {
      volume_.move_camera(i, observer.camera.T_world_cam(), observer.depth);
    } else {
      volume_.set_depth(i, observer.depth);
    }
  }

  void add_camera() {
    if (world_.cameras.size() >= 5) return;
    const PinholeCamera camera = test::random_observer(random_);
    world_.cameras.push_back({"new", camera, measured_by(camera)});
    CHECK(volume_.add_camera(world_.cameras.back()) == world_.cameras.size() - 1);
    CHECK(volume_.camera_count() == world_.cameras.size());
  }

  void remove_camera() {
    if (world_.cameras.empty()) return;
    const std::size_t i = random_.below(std::uint32_t(world_.cameras.size()));
    world_.cameras.erase(world_.cameras.begin() + std::ptrdiff_t(i));
    volume_.remove_camera(i);
    CHECK(volume_.camera_count() == world_.cameras.size());
  }

  /// Objects come, go, move a little or far, change places in the list and their names.
  void change_objects() {
    std::vector<KnownObject>& objects = world_.objects;
    const auto any = [&] { return random_.below(std::uint32_t(objects.size())); };
    const std::uint32_t kind = objects.empty() ? 0 : random_.below(7);
    if (kind <= 1) {
      const auto mesh = meshes_[random_.below(std::uint32_t(meshes_.size()))];
      objects.push_back({"new " + std::to_string(objects.size()), mesh, somewhere()});
    } else if (kind == 2) {
      objects.erase(objects.begin() + std::ptrdiff_t(any()));
    } else if (kind == 3) {
      KnownObject& moved = objects[any()];
      moved.T_world_object = Pose::from_translation(random_.in_cube(0.01)) * moved.T_world_object;
    } else if (kind == 4) {
      objects[any()].T_world_object = somewhere();
    } else if (kind == 5) {
      std::swap(objects[any()], objects[any()]);
      objects[any()].name += "'";
    } else {
      objects.push_back(objects[any()]);  // there twice
    }
    volume_.set_objects(objects);
  }

  std::shared_ptr<const StateGrid> grid() const { return volume_.grid(); }
  std::shared_ptr<const StateGrid> from_scratch() const {
    return classify(world_, test::small_grid(), options_);
  }

 private:
  Pose somewhere() {
    return Pose::from_translation({0, 0, 0.1}) * random_.pose(random_.below(4) == 0 ? 0.3 : 0.08);
  }

  std::shared_ptr<const DepthImage> measured_by(const PinholeCamera& camera) {
    return random_.below(4) != 0 ? test::noisy_depth(*truth_, camera, random_) : nullptr;
  }

  test::Random random_;
  VolumeOptions options_;
  WorldModel world_;
  std::shared_ptr<const Scene> truth_;
  ShadowVolume volume_;
  std::vector<std::shared_ptr<const TriangleMesh>> meshes_;
};

void expect_what_starting_over_gives(const Follower& follower) {
  const auto grid = follower.grid(), expected = follower.from_scratch();
  REQUIRE(grid != nullptr);
  test::expect_same_grid(*grid, *expected);
  expect_same_trees(*grid, *expected);
  CHECK(grid->centres(VoxelState::shadow).x == expected->centres(VoxelState::shadow).x);
  CHECK(follower.grid() == grid);  // nothing has changed since
}

}  // namespace

TEST_CASE("after any sequence of changes a volume is what starting over gives") {
  for (const VolumeOptions& options : test::all_volume_modes()) {
    for (std::uint32_t seed = 0; seed < test::scene_count(6); ++seed) {
      CAPTURE(seed);
      Follower follower(seed, options);
      const auto first = follower.grid(), first_from_scratch = follower.from_scratch();
      test::expect_same_grid(*first, *first_from_scratch);
      for (int step = 0; step < 24; ++step) {
        CAPTURE(step);
        follower.change_something();
        if (step % 4 == 1) continue;  // several changes between two grids
        expect_what_starting_over_gives(follower);
      }
      test::expect_same_grid(*first, *first_from_scratch);  // grids handed out do not change
    }
  }
}

TEST_CASE("after any sequence of changes to the objects a volume is what starting over gives") {
  for (const VolumeOptions& options : test::all_volume_modes()) {
    for (std::uint32_t seed = 100; seed < 100 + test::scene_count(6); ++seed) {
      CAPTURE(seed);
      Follower follower(seed, options);
      for (int step = 0; step < 24; ++step) {
        CAPTURE(step);
        follower.change_objects();
        expect_what_starting_over_gives(follower);
      }
    }
  }
}

TEST_CASE("many objects that move at once, and one of them alone") {
  for (const VolumeOptions& options : test::all_volume_modes()) {
    test::Random random(3);
    WorldModel world = test::random_workcell(3);
    const auto mesh = std::make_shared<const TriangleMesh>(test::icosphere(0.008, 1));
    const auto somewhere = [&] { return Pose::from_translation({0, 0, 0.1}) * random.pose(0.1); };
    for (int i = 0; i < 80; ++i) world.objects.push_back({"ball", mesh, somewhere()});
    ShadowVolume volume(world, test::small_grid(), options);
    const auto first = volume.grid();
    for (KnownObject& object : world.objects) object.T_world_object = somewhere();
    volume.set_objects(world.objects);
    const auto moved = volume.grid();
    test::expect_same_grid(*moved, *classify(world, test::small_grid(), options));
    CHECK(moved->centres(VoxelState::occupied).x != first->centres(VoxelState::occupied).x);
    world.objects.back().T_world_object = somewhere();
    volume.set_objects(world.objects);
    test::expect_same_grid(*volume.grid(), *classify(world, test::small_grid(), options));
  }
}

TEST_CASE("objects that stay where they are cost no new grid, and their names count") {
  const WorldModel world = test::random_workcell(4);
  ShadowVolume volume(world, test::small_grid());
  const auto before = volume.grid();
  CHECK(volume.grid() == before);
  volume.set_depth(0, world.cameras[0].depth);
  CHECK(volume.grid() == before);
  volume.set_objects(world.objects);
  test::expect_same_grid(*volume.grid(), *before);
  volume.set_objects({});
  CHECK(volume.grid()->count(VoxelState::occupied) < before->count(VoxelState::occupied));
  volume.set_objects(world.objects);
  test::expect_same_grid(*volume.grid(), *before);
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
  test::expect_bad_input("camera", std::to_string(none), [&] { volume.remove_camera(none); });
  const auto misfit = std::make_shared<const DepthImage>(3, 4);
  test::expect_bad_input("camera wide", "3×4", [&] {
    volume.add_camera({"wide", world.cameras[0].camera, misfit});
  });
  test::expect_bad_input("object ghost", "no mesh", [&] {
    volume.set_objects({{"ghost", nullptr, {}}});
  });
  CHECK(volume.camera_count() == none);
  test::expect_bad_input("camera 0", "3×4", [&] { volume.set_depth(0, misfit); });
  test::expect_bad_input("camera 0", "3×4", [&] {
    volume.move_camera(0, Pose::from_translation({0, 0, 1}) * pose, misfit);
  });
  test::expect_same_grid(*before, *volume.grid());
}

TEST_CASE("a volume that was stopped stays without a grid") {
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

TEST_CASE("new objects that were stopped leave no grid until they are set again") {
  for (const VolumeOptions& options : test::all_volume_modes()) {
    const WorldModel world = test::random_workcell(1);
    const StopToken stop;
    stop.cancel();
    ShadowVolume volume(world, test::small_grid(), options);
    const auto before = volume.grid();
    volume.set_objects(world.objects, stop);
    CHECK(volume.grid() == nullptr);
    volume.set_depth(0, world.cameras[0].depth);
    CHECK(volume.grid() == nullptr);
    volume.set_objects(world.objects);
    test::expect_same_grid(*before, *volume.grid());
  }
}

TEST_CASE("a camera whose addition was stopped leaves no grid until it is moved or removed") {
  const WorldModel world = test::random_workcell(1);
  const DepthCamera& camera = world.cameras[0];
  const StopToken stop;
  stop.cancel();
  ShadowVolume volume(world, test::small_grid());
  const auto before = volume.grid();
  const std::size_t added = volume.add_camera(camera, stop);
  CHECK(volume.grid() == nullptr);
  volume.set_objects({});  // traces it, but what it measured is not there
  CHECK(volume.grid() == nullptr);
  volume.set_objects(world.objects);
  volume.set_depth(added, camera.depth);
  const auto twice = volume.grid();  // the camera's twin sees what it sees
  test::expect_same_grid(*before, *twice);
  volume.add_camera(camera, stop);
  CHECK(volume.grid() == nullptr);
  volume.move_camera(added + 1, camera.camera.T_world_cam(), camera.depth);
  test::expect_same_grid(*before, *volume.grid());
  volume.add_camera(camera, stop);
  volume.remove_camera(added + 2);
  test::expect_same_grid(*before, *volume.grid());
}

}  // namespace vantage
