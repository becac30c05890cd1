#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <array>
#include <cmath>
#include <limits>

#include "support/expect_error.hpp"
#include "vantage/volume/advanced/shadow_filter.hpp"
#include "vantage/volume/advanced/shadow_regions.hpp"
#include "volume/make_grid.hpp"

namespace vantage {
namespace {

using test::ball;
using test::box;
using test::geometry_of;
using test::make_grid;
using test::shadow_where;

/// Whether a cube around some voxel near `voxel` holds it and is all shadow.
bool fits(const StateGrid& grid, const Eigen::Vector3i& voxel, int radius) {
  const auto all_shadow = [&](const Eigen::Vector3i& centre) {
    for (int i = -radius; i <= radius; ++i)
      for (int j = -radius; j <= radius; ++j)
        for (int k = -radius; k <= radius; ++k)
          if (grid.at(centre + Eigen::Vector3i(i, j, k)) != VoxelState::shadow) return false;
    return true;
  };
  for (int i = -radius; i <= radius; ++i)
    for (int j = -radius; j <= radius; ++j)
      for (int k = -radius; k <= radius; ++k)
        if (all_shadow(voxel + Eigen::Vector3i(i, j, k))) return true;
  return false;
}

/// Checks every voxel of a filtered grid against `stays`, and what the grid says of itself.
template <class Stays>
void expect_filtered(const StateGrid& before, const StateGrid& after, const Stays& stays) {
  std::size_t differences = 0, shadow = 0, outside_removed = 0;
  test::for_each_voxel(before.geometry(), [&](const Eigen::Vector3i& voxel) {
    const bool was_shadow = before.at(voxel) == VoxelState::shadow;
    const bool removed = was_shadow && !stays(voxel);
    const VoxelState expected = removed ? VoxelState::free : before.at(voxel);
    const bool unseen = (before.shadow_cause(voxel) == ShadowCause::outside) && !removed;
    differences += after.at(voxel) != expected ||
                   (after.shadow_cause(voxel) == ShadowCause::outside) != unseen ||
                   after.measured(voxel) != before.measured(voxel);
    shadow += expected == VoxelState::shadow;
    outside_removed += removed && before.shadow_cause(voxel) == ShadowCause::outside;
  });
  CHECK(differences == 0);
  CHECK(after.count(VoxelState::shadow) == shadow);
  CHECK(after.count(VoxelState::free) + shadow ==
        before.count(VoxelState::free) + before.count(VoxelState::shadow));
  CHECK(before.report().outside_shadow - after.report().outside_shadow == outside_removed);
}

/// Mostly uniform blocks, and slivers, balls and single voxels of shadow.
std::shared_ptr<const StateGrid> mixed_grid() {
  const auto noise = test::random_voxels(11);
  return make_grid(geometry_of(30, 27, 25), [=](const Eigen::Vector3i& v) {
    if (box({2, 2, 0}, {28, 25, 2})(v) || ball({12, 12, 12}, 7)(v) ||
        box({3, 3, 20}, {9, 9, 23})(v))
      return test::MadeVoxel{VoxelState::shadow, false, test::outside_if(v.x() < 12)};
    return v.y() > 20 ? noise(v) : test::MadeVoxel{};
  });
}

}  // namespace

TEST_CASE("the shell is the surface of the shadow's voxels and those around them, box or no box") {
  const auto grid = mixed_grid();
  const GridGeometry& geometry = grid->geometry();
  const auto near_shadow = [&](const Eigen::Vector3i& voxel) {
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          if (grid->at(voxel + Eigen::Vector3i(i, j, k)) == VoxelState::shadow) return true;
    return false;
  };
  std::size_t inside = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (int x = -2; x < 32; ++x)
    for (int y = -2; y < 29; ++y)
      for (int z = -2; z < 27; ++z)
        if (near_shadow({x, y, z})) ++inside, moment += Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
  REQUIRE(inside > 1000);
  // By the divergence theorem: outwards, closed, and nothing else, if volume and middle agree.
  const TriangleMesh shell = shell_around_shadow(*grid);
  double six_volumes = 0;
  Eigen::Vector3d its_moment = Eigen::Vector3d::Zero();
  for (const Triangle& triangle : shell.triangles()) {
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = (shell.vertices()[triangle[i]].cast<double>() - geometry.origin()) /
             geometry.voxel_size_m();
    }
    const double part = p[0].dot(p[1].cross(p[2]));
    six_volumes += part;
    its_moment += part / 24 * (p[0] + p[1] + p[2]);
  }
  CHECK(six_volumes / 6 == doctest::Approx(double(inside)).epsilon(1e-5));
  CHECK((its_moment - moment).norm() < 1e-5 * moment.norm());
}

TEST_CASE("an opening's radius is the largest whose cubes are no larger than the edge") {
  const auto grid = mixed_grid();
  const double voxel_m = grid->geometry().voxel_size_m();
  CHECK(opening_radius(*grid, 0) == 0);
  CHECK(opening_radius(*grid, 2.9 * voxel_m) == 0);
  CHECK(opening_radius(*grid, 3 * voxel_m) == 1);
  CHECK(opening_radius(*grid, 4.9 * voxel_m) == 1);
  CHECK(opening_radius(*grid, 5 * voxel_m) == 2);
  for (const double edge_m : {-0.1, std::nan(""), std::numeric_limits<double>::infinity()}) {
    test::expect_bad_input("edge_m", "expected a finite length",
                           [&] { (void)opening_radius(*grid, edge_m); });
  }
}

TEST_CASE("opened shadow is what cubes of shadow fit around") {
  const auto grid = mixed_grid();
  for (const int radius : {0, 1, 2, 3}) {
    CAPTURE(radius);
    const auto opened = morphological_open(*grid, radius);
    expect_filtered(*grid, *opened,
                    [&](const Eigen::Vector3i& voxel) { return fits(*grid, voxel, radius); });
    CHECK((radius == 0 || opened->count(VoxelState::shadow) < grid->count(VoxelState::shadow)));
  }
}

TEST_CASE("opening takes layers on the floor away, and leaves what is thick up to the border") {
  const GridGeometry geometry = geometry_of(24, 24, 24);
  const auto layer = shadow_where(geometry, box({0, 0, 0}, {24, 24, 2}));
  CHECK(morphological_open(*layer, 1)->count(VoxelState::shadow) == 0);
  const auto thick = shadow_where(geometry, box({0, 0, 0}, {24, 24, 3}));
  CHECK(morphological_open(*thick, 1)->count(VoxelState::shadow) == 24 * 24 * 3);
  const auto all = shadow_where(geometry, [](const Eigen::Vector3i&) { return true; });
  CHECK(morphological_open(*all, 4)->count(VoxelState::shadow) == geometry.voxel_count());
}

TEST_CASE("large shadow is that of the regions of at least a volume") {
  const auto grid = mixed_grid();
  const ShadowRegions regions(*grid);
  REQUIRE(regions.list().size() > 5);
  const double voxel_m3 = grid->geometry().voxel_volume_m3();
  for (const double min_voxels : {0.0, 1.5, 50.0, 109.0, 1e6}) {
    CAPTURE(min_voxels);
    const auto large = remove_small_components(*grid, min_voxels * voxel_m3);
    expect_filtered(*grid, *large, [&](const Eigen::Vector3i& voxel) {
      const auto label = std::size_t(regions.label(voxel));
      return double(regions.list()[label - 1].voxels) >= min_voxels;
    });
  }
  // The plate of 6 × 6 × 3 goes between 107 and 109 voxels.
  const Eigen::Vector3i in_plate(4, 4, 21);
  CHECK(remove_small_components(*grid, 107.5 * voxel_m3)->at(in_plate) == VoxelState::shadow);
  CHECK(remove_small_components(*grid, 108.5 * voxel_m3)->at(in_plate) == VoxelState::free);
}

TEST_CASE("shadow filters: threads make no difference, and bad sizes are refused") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const auto grid = mixed_grid();
  const auto at_threads = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute(
        [&] { return remove_small_components(*morphological_open(*grid, 1), 1e-4); });
  };
  const auto one = at_threads(1), many = at_threads(8);
  std::size_t differences = 0;
  test::for_each_voxel(grid->geometry(), [&](const Eigen::Vector3i& voxel) {
    differences += one->at(voxel) != many->at(voxel);
  });
  CHECK(differences == 0);
  CHECK(one->count(VoxelState::shadow) > 0);
  for (const int bad : {-1, 65}) {
    test::expect_bad_input("radius_voxels", "expected 0 to 64",
                           [&] { morphological_open(*grid, bad); });
  }
  for (const double bad : {-1e-9, std::nan(""), std::numeric_limits<double>::infinity()}) {
    test::expect_bad_input("min_m3", "expected a finite volume",
                           [&] { remove_small_components(*grid, bad); });
  }
}

TEST_CASE("planning treats thin shadow as free where depth is noisy, and reports how much") {
  // A thick ball, and a layer on the floor.
  const auto inside = ball({12, 12, 14}, 5);
  const auto grid = shadow_where(geometry_of(24, 24, 24), [&](const Eigen::Vector3i& voxel) {
    return voxel.z() == 0 || inside(voxel);
  });
  WorldModel blind, measured;
  const PinholeCamera camera({64, 48, 70, 70, 31.5, 23.5}, Pose());
  blind.cameras.push_back({"a", camera, nullptr});
  measured.cameras.push_back({"a", camera, std::make_shared<const DepthImage>(64, 48)});
  VolumeOptions options;
  CHECK(without_false_shadow(grid, blind, options) == grid);
  const auto filtered = without_false_shadow(grid, measured, options);
  CHECK(filtered->report().false_shadow ==
        grid->count(VoxelState::shadow) - filtered->count(VoxelState::shadow));
  CHECK(filtered->report().false_shadow >= 24 * 24);
  CHECK(filtered->at({3, 3, 0}) == VoxelState::free);
  CHECK(filtered->at({12, 12, 14}) == VoxelState::shadow);
  CHECK(without_false_shadow(filtered, measured, options)->count(VoxelState::shadow) ==
        filtered->count(VoxelState::shadow));

  options.noise.subpixel_px = 0;  // nothing to be filtered
  CHECK(without_false_shadow(grid, measured, options) == grid);
  options.filter = FalseShadowFilter::on;
  CHECK(without_false_shadow(grid, blind, options)->report().false_shadow > 0);
  options = {.filter = FalseShadowFilter::off};
  CHECK(without_false_shadow(grid, measured, options) == grid);
  // A wider edge takes more.
  const VolumeOptions wide{.filter_m = 0.2};
  CHECK(without_false_shadow(grid, measured, wide) == grid);  // all would go, so nothing does
  const VolumeOptions wide_on{.filter = FalseShadowFilter::on, .filter_m = 0.2};
  CHECK(without_false_shadow(grid, measured, wide_on)->count(VoxelState::shadow) == 0);
  test::expect_bad_input("filter_m", "0 or above", [&] {
    without_false_shadow(grid, measured, VolumeOptions{.filter_m = -1});
  });
}

}  // namespace vantage
