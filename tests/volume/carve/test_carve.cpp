#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "reference/noisy_depth.hpp"
#include "reference/plain_carve.hpp"
#include "reference/random_workcell.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/volume/advanced/carve.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "vantage/volume/advanced/visibility.hpp"
#include "volume/same_grid.hpp"

namespace vantage {
namespace {

using test::Random;

std::vector<float> random_axis(Random& random, double first, double length) {
  std::vector<float> axis{float(first)};
  const std::uint32_t cells = 1 + random.below(20);
  for (std::uint32_t i = 0; i < cells; ++i) {
    axis.push_back(axis.back() + float(random.uniform(0.02, 2) * length / cells));
  }
  return axis;
}

/// Vertices at odd places, also between and beyond the image's pixels; depths without any order,
/// with holes.
VisibilityMesh random_lattice(Random& random, const Box& area) {
  const Eigen::Vector3d target = area.centre() + random.in_cube(0.05);
  const double distance = random.below(4) == 0 ? 0.05 : random.uniform(0.2, 0.6);  // or inside
  const PinholeCamera camera({61, 47, random.uniform(40, 120), random.uniform(40, 120), 30.2, 23.7},
                             Pose::looking_at(target + distance * random.direction(), target));
  VisibilityMesh lattice{camera,
                         random_axis(random, random.uniform(-10, 30), 50),
                         random_axis(random, random.uniform(-10, 20), 40),
                         {}};
  const double roughness = random.below(2) == 0 ? 0.02 : 0.3;
  for (std::size_t n = 0; n < lattice.width() * lattice.height(); ++n) {
    const double depth = std::max(distance + random.uniform(-1, 1) * roughness, 0.01);
    lattice.depth.push_back(random.below(8) == 0 ? DepthImage::kUnknown : float(depth));
  }
  return lattice;
}

std::vector<VisibilityMesh> random_lattices(Random& random, const Box& area) {
  std::vector<VisibilityMesh> lattices;
  const std::uint32_t count = random.below(4);
  for (std::uint32_t i = 0; i < count; ++i) lattices.push_back(random_lattice(random, area));
  return lattices;
}

/// What a random workcell's new observer measures, as a mesh of any step.
std::vector<VisibilityMesh> measured_lattices(const WorldModel& world, Random& random) {
  const auto scene = test::scene_with_foreign_box(world, random);
  std::vector<VisibilityMesh> lattices;
  for (const int step : {1, 3, 8}) {
    const PinholeCamera camera = test::random_observer(random);
    VisibilityOptions options;
    options.step_px = step;
    options.holes = random.below(2) == 0 ? DepthHoles::fill : DepthHoles::unknown;
    const auto lattice = visibility_lattice({camera, test::noisy_depth(*scene, camera, random)},
                                            test::random_workcell_area(), StereoNoise(), options);
    if (lattice) lattices.push_back(*lattice);
  }
  return lattices;
}

struct CarveTally {
  std::size_t voxels = 0, close_calls = 0, differences = 0, free = 0, shadow = 0, unseen = 0;
};

/// Compares a carved grid with its twin, voxel by voxel; known objects are `classify`'s.
void tally_up(const StateGrid& grid, std::span<const VisibilityMesh> lattices,
              const StateGrid& objects_alone, CarveTally& tally) {
  test::for_each_voxel(grid.geometry(), [&](const Eigen::Vector3i& voxel) {
    const Eigen::Vector3d centre = grid.geometry().centre(voxel);
    const test::PlainSeen seen = test::plain_seen(lattices, centre);
    const test::PlainSeen covered = test::plain_covered(lattices, centre);
    ++tally.voxels;
    if (seen.close_call || covered.close_call) {
      ++tally.close_calls;
      return;
    }
    const bool solid = objects_alone.at(voxel) == VoxelState::occupied;
    const VoxelState expected = solid       ? VoxelState::occupied
                                : seen.seen ? VoxelState::free
                                            : VoxelState::shadow;
    const bool unseen = expected == VoxelState::shadow && !covered.seen;
    tally.differences +=
        grid.at(voxel) != expected || (grid.shadow_cause(voxel) == ShadowCause::outside) != unseen;
    tally.free += expected == VoxelState::free;
    tally.shadow += expected == VoxelState::shadow;
    tally.unseen += unseen;
  });
}

void expect_agreement(const CarveTally& tally) {
  CAPTURE(tally.voxels);
  CHECK(tally.differences == 0);
  CHECK(tally.close_calls * 10000 < tally.voxels);
  CHECK(tally.free >= test::enough(tally.voxels / 20));
  CHECK(tally.shadow >= test::enough(tally.voxels / 20));
  CHECK(tally.unseen >= test::enough(tally.voxels / 40));
  CHECK(tally.shadow > tally.unseen);
}

WorldModel without_cameras(WorldModel world) {
  world.cameras.clear();
  return world;
}

}  // namespace

TEST_CASE("carving is asking every lattice about every voxel") {
  CarveTally tally;
  for (std::uint32_t seed = 0; seed < test::scene_count(30); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const WorldModel world = without_cameras(test::random_workcell(seed));
    const GridGeometry geometry =
        GridGeometry::covering(test::random_workcell_area(), random.uniform(0.006, 0.015));
    const auto lattices = random_lattices(random, test::random_workcell_area());
    tally_up(*carve(lattices, geometry, world), lattices, *classify(world, geometry), tally);
  }
  expect_agreement(tally);
}

TEST_CASE("carving is asking, with lattices of what cameras measured") {
  CarveTally tally;
  for (std::uint32_t seed = 0; seed < test::scene_count(12); ++seed) {
    CAPTURE(seed);
    Random random(1000 + seed);
    const WorldModel world = without_cameras(test::random_workcell(seed));
    const GridGeometry geometry = GridGeometry::covering(test::random_workcell_area(), 0.007);
    const auto lattices = measured_lattices(world, random);
    tally_up(*carve(lattices, geometry, world), lattices, *classify(world, geometry), tally);
  }
  expect_agreement(tally);
}

TEST_CASE("carving is asking, with lattices far wider than any image") {
  CarveTally tally;
  for (std::uint32_t seed = 0; seed < test::scene_count(6); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Box area = test::random_workcell_area();
    std::vector<VisibilityMesh> lattices{random_lattice(random, area)};
    for (std::vector<float>* axis : {&lattices[0].columns, &lattices[0].rows}) {
      axis->front() = -30000;
      axis->back() = 40000;
    }
    const GridGeometry geometry = GridGeometry::covering(area, 0.008);
    tally_up(*carve(lattices, geometry, {}), lattices, *classify({}, geometry), tally);
  }
  CHECK(tally.differences == 0);
  CHECK(tally.close_calls * 10000 < tally.voxels);
  CHECK(tally.free >= test::enough(tally.voxels / 20));
  CHECK(tally.shadow >= test::enough(tally.voxels / 20));
}

TEST_CASE("carving a far away work area loses no precision") {
  Random random(5);
  const Eigen::Vector3d away(1000, -2000, 500);
  for (std::uint32_t seed = 0; seed < test::scene_count(6); ++seed) {
    const WorldModel world = without_cameras(test::random_workcell(seed));
    auto lattices = measured_lattices(world, random);
    const Box area = test::random_workcell_area();
    const auto near = carve(lattices, GridGeometry::covering(area, 0.008), {});
    for (VisibilityMesh& lattice : lattices) {
      lattice.camera =
          lattice.camera.moved_to(Pose::from_translation(away) * lattice.camera.T_world_cam());
    }
    const Box moved(area.min() + away, area.max() + away);
    const auto far = carve(lattices, GridGeometry::covering(moved, 0.008), {});
    const double difference =
        double(near->count(VoxelState::shadow)) - double(far->count(VoxelState::shadow));
    CHECK(std::abs(difference) < 3);
    CHECK(near->count(VoxelState::free) > 100);
  }
}

TEST_CASE("without lattices everything is unseen shadow") {
  const GridGeometry geometry = GridGeometry::covering(test::random_workcell_area(), 0.013);
  const auto grid = carve({}, geometry, {});
  CHECK(grid->count(VoxelState::shadow) == geometry.voxel_count());
  CHECK(grid->report().outside_shadow == geometry.voxel_count());
}

TEST_CASE("what a lattice sees through a known object is reported as a conflict") {
  const Box area({-0.1, -0.1, 0}, {0.1, 0.1, 0.1});
  const PinholeCamera camera({64, 48, 60, 60, 31.5, 23.5},
                             Pose::looking_at({0, 0, 0.5}, {0, 0, 0}));
  const auto far = std::make_shared<const DepthImage>(64, 48, std::vector<float>(64 * 48, 1.0f));
  const std::vector<VisibilityMesh> lattices{
      *visibility_lattice({camera, far}, area, StereoNoise())};
  const auto cube = std::make_shared<const TriangleMesh>(
      TriangleMesh::from_box(Box({-0.02, -0.02, 0.02}, {0.02, 0.02, 0.06})));
  const WorldModel world{{{"cube", cube, {}}}, {}, {}};
  const auto grid = carve(lattices, GridGeometry::covering(area, 0.01), world);
  CHECK(grid->count(VoxelState::occupied) == 64);
  CHECK(grid->count(VoxelState::shadow) == 0);
  REQUIRE(grid->report().conflicts.size() == 1);
  CHECK(grid->report().conflicts[0].object == "cube");
  CHECK(grid->report().conflicts[0].voxels == 64);
}

TEST_CASE("carving gives the same grid at any number of threads") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  Random random(9);
  const WorldModel world = without_cameras(test::random_workcell(3));
  const auto lattices = measured_lattices(world, random);
  const GridGeometry geometry = GridGeometry::covering(test::random_workcell_area(), 0.003);
  const auto at_threads = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] { return carve(lattices, geometry, world); });
  };
  const auto grid = at_threads(1);
  for (const int threads : {2, 8}) test::expect_same_grid(*at_threads(threads), *grid);
}

TEST_CASE("carving stops when asked to, and refuses bad lattices and objects without a mesh") {
  const GridGeometry geometry = GridGeometry::covering(test::random_workcell_area(), 0.03);
  const StopToken stopped;
  stopped.cancel();
  CHECK(carve({}, geometry, {}, stopped) == nullptr);

  const PinholeCamera camera({64, 48, 60, 60, 31.5, 23.5}, {});
  const std::vector<VisibilityMesh> bad{{camera, {0, 8}, {0, 8}, {1, 1, -1, 1}}};
  test::expect_bad_input("depth", "", [&] { carve(bad, geometry, {}); });
  WorldModel world;
  world.objects.push_back({"nothing", nullptr, {}});
  test::expect_bad_input("object nothing", "it has no mesh", [&] { carve({}, geometry, world); });
}

}  // namespace vantage
