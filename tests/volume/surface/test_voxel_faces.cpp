#include <doctest/doctest.h>

#include <cmath>

#include "vantage/volume/advanced/voxel_surface.hpp"
#include "volume/make_grid.hpp"
#include "volume/mesh_measures.hpp"

namespace vantage {
namespace {

using test::box;
using test::geometry_of;
using test::make_grid;
using test::shadow_where;

/// Six times the volume inside a closed mesh of voxel corners, in voxels: the divergence theorem in
/// integers, so that nothing is rounded.
std::int64_t six_volumes(const TriangleMesh& mesh, const GridGeometry& geometry) {
  using Integers = Eigen::Matrix<std::int64_t, 3, 1>;
  const auto corner = [&](std::size_t t, int c) -> Integers {
    const Eigen::Vector3d index =
        (mesh.corner(t, c).cast<double>() - geometry.origin()) / geometry.voxel_size_m();
    REQUIRE((index - index.array().round().matrix()).norm() < 1e-3);
    return index.array().round().cast<std::int64_t>();
  };
  std::int64_t volume = 0;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    volume += corner(t, 0).dot(corner(t, 1).cross(corner(t, 2)));
  }
  return volume;
}

/// Faces between voxels of a state and others, counted one by one.
std::size_t count_faces(const StateGrid& grid, VoxelState state) {
  std::size_t faces = 0;
  test::for_each_voxel(grid.geometry(), [&](const Eigen::Vector3i& voxel) {
    if (grid.at(voxel) != state) return;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        Eigen::Vector3i neighbour = voxel;
        neighbour[axis] += step;
        faces += grid.at(neighbour) != state || !grid.geometry().contains(neighbour);
      }
    }
  });
  return faces;
}

/// Calls `visit` with the voxels in front of a mesh's faces.
template <class Visit>
void for_each_in_front(const TriangleMesh& faces, const GridGeometry& geometry,
                       const Visit& visit) {
  const auto corner = [&](std::size_t t, int c) -> Eigen::Vector3d {
    return (faces.corner(t, c).cast<double>() - geometry.origin()) / geometry.voxel_size_m();
  };
  for (std::size_t t = 0; t < faces.triangles().size(); t += 2) {
    const Eigen::Vector3d a = corner(t, 0), down = corner(t, 1) - a,
                          across = corner(t, 2) - a - down;
    const Eigen::Vector3d outwards = down.cross(across).normalized();
    const double rows = std::round(down.norm()), columns = std::round(across.norm());
    for (double row = 0.5; row < rows; ++row) {
      for (double column = 0.5; column < columns; ++column) {
        const Eigen::Vector3d p =
            a + row / rows * down + column / columns * across + 0.5 * outwards;
        visit(Eigen::Vector3i(p.array().floor().cast<int>()));
      }
    }
  }
}

}  // namespace

TEST_CASE("the faces of a state enclose its voxels exactly, and merge") {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    const GridGeometry geometry = geometry_of(37, 24, 19);
    const auto grid = make_grid(geometry, test::random_voxels(seed));
    for (const VoxelState state :
         {VoxelState::free, VoxelState::occupied, VoxelState::shadow, VoxelState::revealed}) {
      CAPTURE(int(state));
      const TriangleMesh faces = voxel_faces(*grid, state);
      CHECK(six_volumes(faces, geometry) == 6 * std::int64_t(grid->count(state)));
      const double face_m2 = std::pow(geometry.voxel_size_m(), 2);
      const std::size_t count = count_faces(*grid, state);
      CHECK(std::abs(test::area_m2(faces) / (double(count) * face_m2) - 1) < 1e-4);
      CHECK(faces.dropped_degenerate() == 0);
      CHECK(faces.triangles().size() < 2 * count);
    }
  }
}

TEST_CASE("faces are merged into rectangles, also through blocks, leaves and tiles") {
  const GridGeometry geometry = geometry_of(150, 140, 136);
  const auto slab = shadow_where(geometry, box({3, 0, 0}, {147, 140, 136}));
  const TriangleMesh faces = voxel_faces(*slab, VoxelState::shadow);
  CHECK(faces.triangles().size() == 12);
  CHECK(faces.vertices().size() == 8);
  CHECK(six_volumes(faces, geometry) == 6 * std::int64_t(slab->count(VoxelState::shadow)));
  // An L: two rectangles on the top and on the bottom, six sides.
  const auto step = shadow_where(geometry_of(20, 20, 20), [](const Eigen::Vector3i& v) {
    return v.z() >= 5 && v.z() < 12 && ((v.x() < 9 && v.y() < 17) || (v.x() < 18 && v.y() < 9));
  });
  CHECK(voxel_faces(*step, VoxelState::shadow).triangles().size() == 2 * (2 + 2 + 6));
}

TEST_CASE("the measured faces are those of the measured voxels") {
  const GridGeometry geometry = geometry_of(24, 24, 24);
  const auto grid = make_grid(geometry, test::random_voxels(5));
  std::int64_t measured = 0;
  test::for_each_voxel(geometry,
                       [&](const Eigen::Vector3i& voxel) { measured += grid->measured(voxel); });
  CHECK(measured > 100);
  CHECK(six_volumes(measured_faces(*grid), geometry) == 6 * measured);
}

TEST_CASE("the shadow's surface is open, but for the faces against solid voxels") {
  const GridGeometry geometry = geometry_of(37, 24, 19);
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    const auto grid = make_grid(geometry, test::random_voxels(seed));
    for (const OccluderMode mode : {OccluderMode::voxels, OccluderMode::mesh}) {
      CAPTURE(int(mode));
      const ShadowSurface surface = shadow_surface(*grid, mode);
      CHECK(six_volumes(surface.open, geometry) + six_volumes(surface.covered, geometry) ==
            6 * std::int64_t(grid->count(VoxelState::shadow)));
      std::size_t open = 0, covered = 0, wrong = 0;
      const auto solid = [&](const Eigen::Vector3i& voxel) {
        return mode == OccluderMode::voxels ? grid->at(voxel) == VoxelState::occupied
                                            : grid->measured(voxel);
      };
      for_each_in_front(surface.open, geometry, [&](const auto& v) { ++open, wrong += solid(v); });
      for_each_in_front(surface.covered, geometry,
                        [&](const auto& v) { ++covered, wrong += !solid(v); });
      CHECK(wrong == 0);
      CHECK(covered > 100);
      CHECK(open + covered == count_faces(*grid, VoxelState::shadow));
    }
  }
}

}  // namespace vantage
