#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "reference/for_each_voxel.hpp"
#include "reference/plain_classify.hpp"
#include "reference/random_workcell.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

const PinholeCamera kCamera({64, 48, 60, 60, 31.5, 23.5},
                            Pose::looking_at({0, -0.5, 0.1}, {0, 0, 0.1}), {0.1, 2});

KnownObject box(const Eigen::Vector3d& min, const Eigen::Vector3d& max, const std::string& name) {
  return {name, std::make_shared<const TriangleMesh>(TriangleMesh::from_box(Box(min, max))), {}};
}

/// 1 cm voxels, 20 × 20 × 20, the floor's centre at the origin.
GridGeometry cube_grid() {
  return GridGeometry::covering(Box({-0.1, -0.1, 0}, {0.1, 0.1, 0.2}), 0.01);
}

}  // namespace

TEST_CASE("classify equals the plain algorithm on random workcells") {
  std::size_t compared = 0, close_calls = 0;
  std::array<std::size_t, 4> seen{};
  std::array<std::size_t, 3> causes{};
  for (std::uint32_t seed = 0; seed < test::scene_count(16); ++seed) {
    CAPTURE(seed);
    const WorldModel world = test::random_workcell(seed);
    const double voxel_size_m = seed % 2 == 0 ? 0.02 : 0.018;
    const GridGeometry geometry =
        GridGeometry::covering(test::random_workcell_area(), voxel_size_m);
    const auto grid = classify(world, geometry);
    const test::PlainClassifier plain(world, geometry);
    test::for_each_voxel(geometry, [&](const Eigen::Vector3i& voxel) {
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
      REQUIRE(grid->shadow_cause(voxel) == expected.cause);
      if (expected.cause) ++causes[std::size_t(*expected.cause)];
    });
  }
  MESSAGE(compared << " voxels compared, " << close_calls << " too close to call");
  CHECK(close_calls * 10 < compared);
  for (const VoxelState state : {VoxelState::free, VoxelState::occupied, VoxelState::shadow}) {
    CHECK(seen[std::size_t(state)] > test::enough(500));
  }
  for (const std::size_t voxels : causes) CHECK(voxels >= test::enough(101));
}

TEST_CASE("a camera without depth: free before and beside a box, shadow behind it") {
  WorldModel world;
  world.objects.push_back(box({-0.03, -0.03, 0.06}, {0.03, 0.03, 0.14}, "box"));
  world.cameras.push_back({"front", kCamera, nullptr});
  const auto grid = classify(world, cube_grid());
  CHECK(grid->at({10, 2, 10}) == VoxelState::free);
  CHECK(grid->at({10, 10, 10}) == VoxelState::occupied);
  CHECK_FALSE(grid->measured({10, 10, 10}));
  CHECK(grid->at({10, 17, 10}) == VoxelState::shadow);
  CHECK(grid->at({0, 10, 10}) == VoxelState::free);
  CHECK(grid->volume_m3(VoxelState::occupied) == doctest::Approx(0.06 * 0.06 * 0.08));
}

TEST_CASE(
    "a depth image: free before the surface, occupied at it, shadow behind and where unknown") {
  WorldModel world;
  auto depth = std::make_shared<DepthImage>(64, 48);  // a wall at y = 0: 0.5 m away
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 40; ++u) depth->set(u, v, 0.5f);  // unknown on the right
  world.cameras.push_back({"front", kCamera, depth});
  const auto grid = classify(world, cube_grid());
  CHECK(grid->at({10, 5, 10}) == VoxelState::free);
  // The wall is the border between the rows 9 and 10; points on a border are in the row above.
  CHECK(grid->at({10, 10, 10}) == VoxelState::occupied);
  CHECK(grid->measured({10, 10, 10}));
  CHECK(grid->at({10, 12, 10}) == VoxelState::shadow);
  CHECK(grid->at({19, 2, 10}) == VoxelState::shadow);
}

TEST_CASE("depth nearer than the near limit, or none, proves nothing: the shadow is unmeasured") {
  for (const float metres : {0.0f, 0.05f, DepthImage::kUnknown}) {
    CAPTURE(metres);
    WorldModel world;
    world.cameras.push_back(
        {"front", kCamera,
         std::make_shared<DepthImage>(64, 48, std::vector<float>(64 * 48, metres))});
    const auto grid = classify(world, cube_grid());
    CHECK(grid->count(VoxelState::shadow) == grid->geometry().voxel_count());
    CHECK(grid->report().unmeasured_shadow + grid->report().outside_shadow ==
          grid->geometry().voxel_count());
    CHECK(grid->shadow_cause({10, 10, 10}) == ShadowCause::unmeasured);
  }
}

TEST_CASE("depth beyond the far limit is a reading: free up to there, and no surface") {
  WorldModel world;
  const PinholeCamera up_to_the_middle(kCamera.intrinsics(), kCamera.T_world_cam(), {0.1, 0.5});
  world.cameras.push_back({"front", up_to_the_middle,
                           std::make_shared<DepthImage>(64, 48, std::vector<float>(64 * 48, 5.f))});
  const auto grid = classify(world, cube_grid());
  CHECK(grid->count(VoxelState::occupied) == 0);
  CHECK(grid->at({10, 2, 10}) == VoxelState::free);
  CHECK(grid->at({10, 17, 10}) == VoxelState::shadow);
  CHECK(grid->shadow_cause({10, 17, 10}) == ShadowCause::outside);  // of the depth range
  CHECK(grid->report().unmeasured_shadow == 0);
}

TEST_CASE("a reading a little beyond the far limit leaves its band in shadow, not occupied") {
  const PinholeCamera camera(kCamera.intrinsics(), kCamera.T_world_cam(), {0.1, 0.5});
  const StereoNoise noise{.subpixel_px = 0.8};  // half the band is 19 mm at half a metre
  const auto at = [&](float metres) {
    WorldModel world;
    world.cameras.push_back(
        {"front", camera,
         std::make_shared<DepthImage>(64, 48, std::vector<float>(64 * 48, metres))});
    return classify(world, cube_grid(), {.noise = noise});
  };
  const auto beyond = at(0.501f), before = at(0.499f);
  CHECK(before->count(VoxelState::occupied) > 0);
  CHECK(beyond->count(VoxelState::occupied) == 0);
  CHECK(beyond->count(VoxelState::free) > 0);
  CHECK(beyond->count(VoxelState::shadow) > before->count(VoxelState::shadow));
}

TEST_CASE("what one camera sees through is free, whatever another one measured there") {
  const PinholeCamera from_side(kCamera.intrinsics(), Pose::looking_at({-0.5, 0, 0.1}, {0, 0, 0.1}),
                                {0.1, 2});
  const auto wall_at = [](float metres) {
    return std::make_shared<DepthImage>(64, 48, std::vector<float>(64 * 48, metres));
  };
  WorldModel world;
  world.cameras.push_back({"front", kCamera, wall_at(0.5f)});
  world.cameras.push_back({"side", from_side, wall_at(1.0f)});
  const auto grid = classify(world, cube_grid());
  CHECK(grid->at({10, 10, 10}) == VoxelState::free);
  world.cameras.pop_back();
  CHECK(classify(world, cube_grid())->at({10, 10, 10}) == VoxelState::occupied);
}

TEST_CASE("a slanted surface has no holes: no ray from behind it slips through") {
  const PinholeCamera camera({640, 480, 525, 525, 319.5, 239.5},
                             Pose::looking_at({0, -0.6, 0.45}, {0, 0, 0.1}), {0.1, 2});
  SceneBuilder truth;  // a table top that the camera sees at 30 degrees
  truth.add_box(Box({-0.5, -0.5, 0}, {0.5, 0.5, 0.1043}));
  WorldModel world;
  world.cameras.push_back(
      {"front", camera, std::make_shared<DepthImage>(truth.build()->render_depth(camera))});
  const auto grid = classify(world, cube_grid());
  const auto occluders = occluder_scene(world, *grid);
  std::size_t rays = 0;
  for (float x = -0.045f; x < 0.05f; x += 0.01f) {
    for (float y = -0.045f; y < 0.05f; y += 0.01f) {
      ++rays;
      CHECK(occluders->occluded({x, y, 0.055f}, {x, y + 0.02f, 0.5f}));
    }
  }
  CHECK(rays >= 81);
}

TEST_CASE("the three states fill the work area, and the counts say so") {
  const WorldModel world = test::random_workcell(3);
  const auto grid = classify(world, GridGeometry::covering(test::random_workcell_area(), 0.01));
  std::array<std::uint64_t, 4> counts{};
  test::for_each_voxel(grid->geometry(), [&](const Eigen::Vector3i& voxel) {
    ++counts[std::size_t(grid->at(voxel))];
  });
  for (int state = 0; state < 4; ++state) {
    CHECK(grid->count(VoxelState(state)) == counts[std::size_t(state)]);
  }
  CHECK(counts[0] + counts[1] + counts[2] == grid->geometry().voxel_count());
}

TEST_CASE("classify gives the same at 1, 2, 3 and 8 threads") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const WorldModel world = test::random_workcell(5);
  const GridGeometry geometry = GridGeometry::covering(test::random_workcell_area(), 0.005);
  std::shared_ptr<const StateGrid> first;
  for (const int threads : {1, 2, 3, 8}) {
    tbb::task_arena arena(threads);
    const auto grid = arena.execute([&] { return classify(world, geometry); });
    if (first == nullptr) first = grid;
    bool same = true;
    test::for_each_voxel(geometry, [&](const Eigen::Vector3i& voxel) {
      same &=
          grid->at(voxel) == first->at(voxel) && grid->measured(voxel) == first->measured(voxel);
    });
    CHECK(same);
    CHECK(grid->centres(VoxelState::shadow).x == first->centres(VoxelState::shadow).x);
  }
}

TEST_CASE("classify stops when cancelled, after it has checked its input") {
  WorldModel world = test::random_workcell(1);
  const StopToken stop;
  stop.cancel();
  CHECK(classify(world, cube_grid(), {}, stop) == nullptr);
  world.objects.push_back({"ghost", nullptr, {}});
  test::expect_bad_input("object ghost", "no mesh",
                         [&] { classify(world, cube_grid(), {}, stop); });
  world.objects.pop_back();
  world.cameras.push_back({"wrong", kCamera, std::make_shared<DepthImage>(3, 4)});
  test::expect_bad_input("camera wrong", "3×4", [&] { classify(world, cube_grid(), {}, stop); });
}

}  // namespace vantage
