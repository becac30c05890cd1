#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <array>
#include <map>

#include "support/expect_error.hpp"
#include "volume/make_grid.hpp"

namespace vantage {
namespace {

using test::for_each_voxel;
using test::geometry_of;
using test::make_grid;
using test::random_voxels;

constexpr VoxelState kAllStates[] = {VoxelState::free, VoxelState::occupied, VoxelState::shadow,
                                     VoxelState::revealed};

bool same_points(const Points& a, const Points& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

std::optional<ShadowCause> cause_of(const test::MadeVoxel& made) {
  const bool dark = made.state == VoxelState::shadow || made.state == VoxelState::revealed;
  return dark ? std::optional(made.cause) : std::nullopt;
}

}  // namespace

TEST_CASE("a grid tells what was put in, leaf or tile, and free outside") {
  const GridGeometry geometry = geometry_of(37, 24, 19);
  for (const bool tiles : {false, true}) {
    const auto grid = make_grid(geometry, random_voxels(1), tiles);
    std::map<VoxelState, std::uint64_t> counts;
    bool same = true;
    for_each_voxel(geometry, [&](const Eigen::Vector3i& voxel) {
      const test::MadeVoxel made = random_voxels(1)(voxel);
      ++counts[made.state];
      same &= grid->at(voxel) == made.state && grid->measured(voxel) == made.measured &&
              grid->shadow_cause(voxel) == cause_of(made);
    });
    CHECK(same);
    for (const VoxelState state : kAllStates) {
      CHECK(counts[state] > 500);
      CHECK(grid->count(state) == counts[state]);
    }
    CHECK(grid->at({-1, 3, 3}) == VoxelState::free);
    CHECK(grid->at({37, 3, 3}) == VoxelState::free);
  }
}

TEST_CASE("centres list each voxel of a state once, block by block, x slowest in a block") {
  const GridGeometry geometry = geometry_of(37, 24, 19);
  const auto grid = make_grid(geometry, random_voxels(2));
  for (const VoxelState state : kAllStates) {
    const Points centres = grid->centres(state);
    REQUIRE(centres.size() == grid->count(state));
    std::array<int, 6> last{-1};
    bool in_order = true, right = true;
    for (std::size_t p = 0; p < centres.size(); ++p) {
      const auto v = geometry.voxel_at(centres[p].cast<double>());
      REQUIRE(v);
      right &= grid->at(*v) == state && geometry.centre(*v).cast<float>() == centres[p];
      const std::array<int, 6> place{v->x() / 8, v->y() / 8, v->z() / 8, v->x(), v->y(), v->z()};
      in_order &= last < place;  // blocks of a grid this small have this order among themselves
      last = place;
    }
    CHECK(right);
    CHECK(in_order);
  }
}

TEST_CASE("the order of centres depends neither on tiles nor on threads") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  // Large enough for tiles of 128³ voxels in a slab that is all shadow.
  const GridGeometry geometry = geometry_of(150, 140, 136);
  const auto slab = [](const Eigen::Vector3i& voxel) -> test::MadeVoxel {
    if (voxel.x() < 130) return {VoxelState::shadow};
    return random_voxels(3)(voxel);
  };
  const auto leaves = make_grid(geometry, slab, false), tiles = make_grid(geometry, slab, true);
  const Points expected = leaves->centres(VoxelState::shadow);
  CHECK(expected.size() == leaves->count(VoxelState::shadow));
  for (const int threads : {1, 3, 8}) {
    tbb::task_arena arena(threads);
    CHECK(same_points(arena.execute([&] { return tiles->centres(VoxelState::shadow); }), expected));
  }
}

TEST_CASE("revealing turns the named shadow voxels, and only those, in a new grid") {
  const GridGeometry geometry = geometry_of(37, 24, 19);
  const auto grid = make_grid(geometry, random_voxels(4));
  const Points shadow = grid->centres(VoxelState::shadow);
  std::vector<std::uint8_t> seen(shadow.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    seen[i] = i % 3 == 0 || shadow[i].x() < -0.2f;  // whole blocks, and parts of others
  }
  const auto after = grid->with_revealed(seen);
  std::uint64_t turned = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto voxel = *geometry.voxel_at(shadow[i].cast<double>());
    CHECK(after->at(voxel) == (seen[i] ? VoxelState::revealed : VoxelState::shadow));
    turned += seen[i];
  }
  std::array<std::uint64_t, 4> counts{};
  for_each_voxel(geometry, [&](const Eigen::Vector3i& voxel) {
    ++counts[std::size_t(after->at(voxel))];
    const test::MadeVoxel made = random_voxels(4)(voxel);
    CHECK(grid->at(voxel) == made.state);
    CHECK(after->shadow_cause(voxel) == cause_of(made));
    CHECK(after->measured(voxel) == made.measured);
    if (made.state != VoxelState::shadow) CHECK(after->at(voxel) == made.state);
  });
  for (const VoxelState state : kAllStates) {
    CHECK(after->count(state) == counts[std::size_t(state)]);
    CHECK(after->centres(state).size() == counts[std::size_t(state)]);
  }
  CHECK(after->count(VoxelState::revealed) == grid->count(VoxelState::revealed) + turned);
  CHECK(after->report().unmeasured_shadow == grid->report().unmeasured_shadow);
  CHECK(after->report().outside_shadow == grid->report().outside_shadow);
  seen.pop_back();
  test::expect_bad_input("revealed voxels", "flags", [&] { grid->with_revealed(seen); });
}

}  // namespace vantage
