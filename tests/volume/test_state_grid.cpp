#include <doctest/doctest.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <map>

#include "reference/random_workcell.hpp"
#include "support/expect_error.hpp"
#include "support/test_data.hpp"
#include "vantage/volume/classify.hpp"

namespace vantage {
namespace {

std::shared_ptr<const StateGrid> some_grid() {
  return classify(test::random_workcell(7),
                  GridGeometry::covering(test::random_workcell_area(), 0.01));
}

/// Volume inside a closed mesh, by the divergence theorem.
double enclosed_volume(const TriangleMesh& mesh) {
  double volume = 0;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const Eigen::Vector3d a = mesh.corner(t, 0).cast<double>(),
                          b = mesh.corner(t, 1).cast<double>(),
                          c = mesh.corner(t, 2).cast<double>();
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const Eigen::Vector3d a = mesh.corner(t, 0).cast<double>(),
                          b = mesh.corner(t, 1).cast<double>(),
                          c = mesh.corner(t, 2).cast<double>();
    sum += (b - a).cross(c - a).norm() / 2;
  }
  return sum;
}

/// Faces between voxels of a state and others, counted one by one.
std::size_t count_faces(const StateGrid& grid, VoxelState state) {
  std::size_t faces = 0;
  const Eigen::Vector3i n = grid.geometry().size();
  for (int i = 0; i < n.x(); ++i)
    for (int j = 0; j < n.y(); ++j)
      for (int k = 0; k < n.z(); ++k) {
        const Eigen::Vector3i voxel(i, j, k);
        if (grid.at(voxel) != state) continue;
        for (int axis = 0; axis < 3; ++axis) {
          for (const int step : {-1, 1}) {
            Eigen::Vector3i neighbour = voxel;
            neighbour[axis] += step;
            faces += grid.at(neighbour) != state || !grid.geometry().contains(neighbour);
          }
        }
      }
  return faces;
}

}  // namespace

TEST_CASE("the faces of a state enclose its voxels exactly") {
  const auto grid = some_grid();
  for (const VoxelState state : {VoxelState::occupied, VoxelState::shadow}) {
    const TriangleMesh faces = grid->faces(state);
    REQUIRE(grid->count(state) > 100);
    CHECK(enclosed_volume(faces) == doctest::Approx(grid->volume_m3(state)).epsilon(1e-4));
    const double face_area = std::pow(grid->geometry().voxel_size_m(), 2);
    CHECK(area(faces) ==
          doctest::Approx(double(count_faces(*grid, state)) * face_area).epsilon(1e-4));
    CHECK(faces.dropped_degenerate() == 0);
    // Merging pays: far fewer triangles than two for each face.
    CHECK(faces.triangles().size() < count_faces(*grid, state));
  }
}

TEST_CASE("centres list each voxel of a state once, at its centre") {
  const auto grid = some_grid();
  const Points centres = grid->centres(VoxelState::shadow);
  REQUIRE(centres.size() == grid->count(VoxelState::shadow));
  std::map<std::array<int, 3>, int> seen;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const auto voxel = grid->geometry().voxel_at(centres[i].cast<double>());
    REQUIRE(voxel);
    CHECK(grid->at(*voxel) == VoxelState::shadow);
    CHECK((grid->geometry().centre(*voxel).cast<float>() - centres[i]).norm() < 1e-7f);
    CHECK(++seen[{voxel->x(), voxel->y(), voxel->z()}] == 1);
  }
}

TEST_CASE("revealing turns the named shadow voxels, and only those, in a new grid") {
  const auto grid = some_grid();
  std::vector<std::uint8_t> seen(grid->count(VoxelState::shadow));
  for (std::size_t i = 0; i < seen.size(); i += 3) seen[i] = 1;
  const auto revealed = grid->with_revealed(seen);
  const Points before = grid->centres(VoxelState::shadow);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto voxel = *grid->geometry().voxel_at(before[i].cast<double>());
    CHECK(revealed->at(voxel) == (seen[i] ? VoxelState::revealed : VoxelState::shadow));
    CHECK(grid->at(voxel) == VoxelState::shadow);
  }
  CHECK(revealed->count(VoxelState::revealed) == (seen.size() + 2) / 3);
  CHECK(revealed->count(VoxelState::shadow) + revealed->count(VoxelState::revealed) == seen.size());
  CHECK(revealed->count(VoxelState::occupied) == grid->count(VoxelState::occupied));
  seen.pop_back();
  test::expect_bad_input("revealed voxels", "flags", [&] { grid->with_revealed(seen); });
}

TEST_CASE("grid.vdb holds the states, and its transform maps indices to voxel centres") {
  const auto grid = some_grid();
  const test::TemporaryFolder folder;
  grid->write_vdb(folder / "grid.vdb");
  openvdb::initialize();
  openvdb::io::File file((folder / "grid.vdb").string());
  file.open();
  const auto read = openvdb::gridPtrCast<openvdb::Int32Grid>(file.readGrid("state"));
  const Eigen::Vector3i n = grid->geometry().size();
  std::size_t wrong = 0;
  for (int i = -1; i <= n.x(); ++i)
    for (int j = -1; j <= n.y(); ++j)
      for (int k = -1; k <= n.z(); ++k) {
        const Eigen::Vector3i voxel(i, j, k);
        const bool inside = grid->geometry().contains(voxel);
        const int expected = inside ? int(grid->at(voxel)) : 0;
        wrong += read->tree().getValue({i, j, k}) != expected;
        wrong += read->tree().isValueOn({i, j, k}) != (expected != 0);
      }
  CHECK(wrong == 0);
  const openvdb::Vec3d centre = read->indexToWorld(openvdb::Coord(3, 4, 5));
  CHECK((grid->geometry().centre({3, 4, 5}) - Eigen::Vector3d(centre.x(), centre.y(), centre.z()))
            .norm() < 1e-12);
  test::expect_bad_input("missing", "", [&] { grid->write_vdb(folder / "missing/grid.vdb"); });
}

}  // namespace vantage
