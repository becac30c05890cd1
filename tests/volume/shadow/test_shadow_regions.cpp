#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "reference/plain_regions.hpp"
#include "vantage/volume/advanced/shadow_regions.hpp"
#include "volume/make_grid.hpp"

namespace vantage {
namespace {

using test::geometry_of;
using test::make_grid;

std::vector<std::int32_t> labels_of(const ShadowRegions& regions) {
  const Eigen::Vector3i n = regions.geometry().size();
  std::vector<std::int32_t> labels(regions.geometry().voxel_count());
  std::int32_t* row = labels.data();
  for (int i = 0; i < n.x(); ++i)
    for (int j = 0; j < n.y(); ++j, row += n.z()) regions.labels_of_row(i, j, row);
  return labels;
}

void check_same(const ShadowRegion& region, const ShadowRegion& expected) {
  CHECK(region.voxels == expected.voxels);
  CHECK(region.unmeasured_voxels == expected.unmeasured_voxels);
  CHECK(region.outside_voxels == expected.outside_voxels);
  CHECK(region.first_voxel == expected.first_voxel);
  CHECK(region.min_voxel == expected.min_voxel);
  CHECK(region.max_voxel == expected.max_voxel);
  CHECK((region.centroid_m - expected.centroid_m).norm() < 1e-9);
}

/// @returns the number of regions.
std::size_t compare(const StateGrid& grid) {
  const ShadowRegions regions(grid);
  const test::PlainRegions plain(grid);
  CHECK(regions.list().size() == plain.list.size());
  for (std::size_t r = 0; r < std::min(regions.list().size(), plain.list.size()); ++r) {
    CAPTURE(r);
    check_same(regions.list()[r], plain.list[r]);
  }
  CHECK(labels_of(regions) == plain.labels);
  bool same = true;
  std::size_t next = 0;
  test::for_each_voxel(grid.geometry(), [&](const Eigen::Vector3i& voxel) {
    same &= regions.label(voxel) == plain.labels[next++];
  });
  CHECK(same);
  CHECK(regions.label({-1, 0, 0}) == 0);
  return plain.list.size();
}

/// Shadow in a share of the voxels, at random; blocks in uniform surroundings are tiles.
std::shared_ptr<const StateGrid> noise(std::uint32_t seed, std::uint32_t percent) {
  return make_grid(geometry_of(29, 24, 35), [=](const Eigen::Vector3i& v) -> test::MadeVoxel {
    if (v.x() >= 8 && v.x() < 16)
      return {VoxelState::shadow, false, test::outside_if(v.y() < 9)};  // whole blocks
    const Eigen::Vector3i key(v.x() + 64 * int(seed), v.y(), v.z());
    std::uint32_t h = 0;
    for (const int c : {key.x(), key.y(), key.z()}) h = (h ^ std::uint32_t(c)) * 2654435761u;
    h ^= h >> 15;
    h *= 2246822519u;
    const bool shadow = (h >> 12) % 100 < percent;
    return {shadow ? VoxelState::shadow : VoxelState::occupied, false, ShadowCause((h >> 7) % 3)};
  });
}

}  // namespace

TEST_CASE("shadow regions equal a plain search, from dust to one lump") {
  std::size_t regions = 0;
  for (const std::uint32_t percent : {3u, 15u, 25u, 31u, 40u, 60u, 97u}) {
    CAPTURE(percent);
    regions += compare(*noise(percent, percent));
  }
  CHECK(regions > 3000);
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    CHECK(compare(*make_grid(geometry_of(37, 24, 19), test::random_voxels(seed))) > 10);
  }
}

TEST_CASE("voxels are connected through faces only, across blocks too") {
  // Two cubes that touch at an edge, at the border of four blocks; a third one touches a corner.
  const auto in = [](const Eigen::Vector3i& v, int x, int y, int z) {
    return v.x() / 4 == x && v.y() / 4 == y && v.z() / 4 == z;
  };
  const auto grid =
      make_grid(geometry_of(16, 16, 16), [&](const Eigen::Vector3i& v) -> test::MadeVoxel {
        const bool shadow = in(v, 1, 1, 1) || in(v, 2, 2, 1) || in(v, 3, 3, 2) || in(v, 3, 3, 3);
        return {shadow ? VoxelState::shadow : VoxelState::free};
      });
  const ShadowRegions regions(*grid);
  REQUIRE(regions.list().size() == 3);
  CHECK(regions.list()[0].voxels == 128);
  CHECK(regions.list()[0].first_voxel == Eigen::Vector3i(12, 12, 8));
  CHECK(regions.list()[0].max_voxel == Eigen::Vector3i(15, 15, 15));
  // Equally large: the lower first voxel goes first.
  CHECK(regions.list()[1].first_voxel == Eigen::Vector3i(4, 4, 4));
  CHECK(regions.list()[2].first_voxel == Eigen::Vector3i(8, 8, 4));
  CHECK((regions.list()[1].centroid_m - grid->geometry().corner({6, 6, 6})).norm() < 1e-12);
  CHECK(regions.label({8, 8, 4}) == 3);
  CHECK(regions.label({0, 0, 0}) == 0);
}

TEST_CASE("a snake through a block checkerboard is one region") {
  // A path one voxel wide, up and down in every column of every layer.
  const auto on_path = [](const Eigen::Vector3i& v) {
    if (v.x() % 2 == 1) return v.z() == 0 && v.y() == (v.x() % 4 == 1 ? 16 : 0);
    if (v.y() % 2 == 1) return v.z() == (v.y() % 4 == 1 ? 16 : 0);
    return true;
  };
  const auto grid =
      make_grid(geometry_of(17, 17, 17), [&](const Eigen::Vector3i& v) -> test::MadeVoxel {
        return {on_path(v) ? VoxelState::shadow : VoxelState::free, false, ShadowCause::outside};
      });
  CHECK(compare(*grid) == 1);
}

TEST_CASE("large tiles are regions like any other, and revealed voxels belong to none") {
  const GridGeometry geometry = geometry_of(150, 140, 136);
  const auto grid = make_grid(geometry, [](const Eigen::Vector3i& v) -> test::MadeVoxel {
    if (v.x() == 130) return {VoxelState::revealed};
    return {VoxelState::shadow, false, test::outside_if(v.x() > 130 && v.z() < 10)};
  });
  const ShadowRegions regions(*grid);
  REQUIRE(regions.list().size() == 2);
  CHECK(regions.list()[0].voxels == 130u * 140 * 136);
  CHECK(regions.list()[0].outside_voxels == 0);
  CHECK((regions.list()[0].centroid_m - geometry.corner({65, 70, 68})).norm() < 1e-12);
  CHECK(regions.list()[1].voxels == 19u * 140 * 136);
  CHECK(regions.list()[1].outside_voxels == 19u * 140 * 10);
  CHECK(regions.list()[1].min_voxel == Eigen::Vector3i(131, 0, 0));
  CHECK(regions.label({130, 5, 5}) == 0);
}

TEST_CASE("shadow regions are the same at any number of threads, and no shadow has none") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const auto grid = noise(1, 30);
  const std::vector<std::int32_t> expected = labels_of(ShadowRegions(*grid));
  for (const int threads : {1, 3, 8}) {
    tbb::task_arena arena(threads);
    CHECK(arena.execute([&] { return labels_of(ShadowRegions(*grid)); }) == expected);
  }
  const auto none = make_grid(geometry_of(9, 9, 9), [](const auto&) { return test::MadeVoxel{}; });
  CHECK(ShadowRegions(*none).list().empty());
}

}  // namespace vantage
