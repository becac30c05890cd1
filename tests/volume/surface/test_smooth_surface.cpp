#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <utility>

#include "vantage/volume/advanced/smooth_surface.hpp"
#include "vantage/volume/advanced/voxel_surface.hpp"
#include "volume/make_grid.hpp"
#include "volume/mesh_measures.hpp"

namespace vantage {
namespace {

using test::ball;
using test::box;
using test::closed;
using test::geometry_of;
using test::make_grid;
using test::shadow_where;

/// Whether every edge has exactly two faces.
bool simple(const TriangleMesh& mesh) {
  for (const auto& [edge, use] : test::edges_of(mesh)) {
    if (use.count != 2) return false;
  }
  return closed(mesh);
}

/// In voxels, how far a point is from the nearest face of the shadow; looks at most two voxels far.
double distance_to_faces(const StateGrid& grid, const Eigen::Vector3f& point) {
  const GridGeometry& geometry = grid.geometry();
  const Eigen::Vector3d at = (point.cast<double>() - geometry.origin()) / geometry.voxel_size_m();
  const Eigen::Vector3i own = at.array().floor().cast<int>();
  double nearest = 1e9;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = -2; k <= 2; ++k) {
        const Eigen::Vector3i voxel = own + Eigen::Vector3i(i, j, k);
        for (int axis = 0; axis < 3; ++axis) {  // the face below the voxel
          const Eigen::Vector3i below = voxel - Eigen::Vector3i::Unit(axis);
          const bool in = grid.at(voxel) == VoxelState::shadow;
          if (in == (grid.at(below) == VoxelState::shadow)) continue;
          Eigen::Vector3d high = voxel.cast<double>() + Eigen::Vector3d::Ones();
          high[axis] = voxel[axis];
          const Eigen::Vector3d on_face = at.cwiseMax(voxel.cast<double>()).cwiseMin(high);
          nearest = std::min(nearest, (at - on_face).norm());
        }
      }
  return nearest;
}

void expect_smooth(const StateGrid& grid, double tolerance) {
  const TriangleMesh mesh = smooth_surface(grid, VoxelState::shadow);
  CHECK(simple(mesh));
  CHECK(mesh.dropped_degenerate() == 0);
  const double volume = test::volume_m3(mesh);
  CHECK(volume > 0);  // it looks outwards
  CHECK(std::abs(volume / grid.volume_m3(VoxelState::shadow) - 1) < tolerance);
  double farthest = 0;
  for (const Eigen::Vector3f& vertex : mesh.vertices()) {
    farthest = std::max(farthest, distance_to_faces(grid, vertex));
  }
  CHECK(farthest < std::sqrt(3.0));
  CHECK(test::area_m2(mesh) < test::area_m2(voxel_faces(grid, VoxelState::shadow)));
}

}  // namespace

TEST_CASE("the smooth surface of a ball and of a box is closed, near the faces, and as large") {
  expect_smooth(*shadow_where(geometry_of(40, 40, 40), ball({20, 19.5, 20.2}, 13)), 0.02);
  expect_smooth(*shadow_where(geometry_of(40, 40, 40), box({5, 8, 11}, {33, 30, 31})), 0.03);
}

TEST_CASE("the smooth surface closes at the work area's border") {
  expect_smooth(*shadow_where(geometry_of(40, 24, 32), [](const Eigen::Vector3i&) { return true; }),
                0.04);
  expect_smooth(*shadow_where(geometry_of(40, 24, 32), ball({0, 12, 16}, 13)), 0.04);
  expect_smooth(*shadow_where(geometry_of(56, 48, 40), box({0, 0, 0}, {52, 48, 36})), 0.03);
}

TEST_CASE("the smooth surface keeps every voxel on its side, however thin the shadow") {
  const GridGeometry geometry = geometry_of(24, 24, 24);
  const auto plate = shadow_where(geometry, box({4, 4, 12}, {20, 20, 13}));
  const TriangleMesh mesh = smooth_surface(*plate, VoxelState::shadow);
  CHECK(simple(mesh));
  CHECK(test::volume_m3(mesh) > 0.3 * plate->volume_m3(VoxelState::shadow));
  // Noise has edges with four faces, but no holes.
  const auto noise = make_grid(geometry, test::random_voxels(6));
  const TriangleMesh many = smooth_surface(*noise, VoxelState::shadow);
  CHECK(closed(many));
  CHECK(std::abs(test::volume_m3(many) / noise->volume_m3(VoxelState::shadow) - 1) < 0.3);
}

TEST_CASE("no shadow has no surface, and threads make no difference") {
  const GridGeometry geometry = geometry_of(24, 24, 24);
  const auto none = shadow_where(geometry, [](const Eigen::Vector3i&) { return false; });
  CHECK(smooth_surface(*none, VoxelState::shadow).empty());
  CHECK(voxel_faces(*none, VoxelState::shadow).empty());

  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const auto grid = make_grid(geometry, test::random_voxels(7));
  const auto at_threads = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] {
      return std::pair(smooth_surface(*grid, VoxelState::shadow),
                       voxel_faces(*grid, VoxelState::shadow));
    });
  };
  const auto [smooth, faces] = at_threads(1);
  for (const int threads : {3, 8}) {
    const auto [same_smooth, same_faces] = at_threads(threads);
    CHECK(same_smooth.vertices() == smooth.vertices());
    CHECK(same_smooth.triangles() == smooth.triangles());
    CHECK(same_faces.vertices() == faces.vertices());
    CHECK(same_faces.triangles() == faces.triangles());
  }
}

}  // namespace vantage
