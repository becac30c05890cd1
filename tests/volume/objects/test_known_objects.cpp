#include <doctest/doctest.h>

#include "reference/random_boxes.hpp"
#include "reference/thesis_volume.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "volume/same_grid.hpp"
#include "volume/small_grid.hpp"
#include "volume/volume_modes.hpp"

namespace vantage {
namespace {

std::shared_ptr<const StateGrid> grid_of(const TriangleMesh& mesh, OccluderMode mode) {
  WorldModel world;
  world.objects.push_back({"object", std::make_shared<const TriangleMesh>(mesh), {}});
  world.cameras.push_back({"front", test::kFront, nullptr});
  return classify(world, test::small_grid(), test::volume_mode(mode, false));
}

TriangleMesh turned_box() {
  const Pose pose = Pose::from_rotation(
      Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(),
      {0.01, 0.02, 0.1});
  return TriangleMesh::from_box(Box({-0.03, -0.04, -0.05}, {0.03, 0.04, 0.05})).transformed(pose);
}

/// Only the triangles for which `keep` holds, each turned over if `flip`.
template <class Keep>
TriangleMesh rebuilt(const TriangleMesh& mesh, const Keep& keep, bool flip) {
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    Triangle triangle = mesh.triangles()[t];
    if (flip) std::swap(triangle[1], triangle[2]);
    if (keep(t)) triangles.push_back(triangle);
  }
  return {mesh.vertices(), std::move(triangles)};
}

/// Both in one mesh.
TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  std::vector<Eigen::Vector3f> vertices = a.vertices();
  std::vector<Triangle> triangles = a.triangles();
  for (const auto& [i, j, k] : b.triangles()) {
    const auto n = std::uint32_t(a.vertices().size());
    triangles.push_back({i + n, j + n, k + n});
  }
  vertices.insert(vertices.end(), b.vertices().begin(), b.vertices().end());
  return {std::move(vertices), std::move(triangles)};
}

}  // namespace

TEST_CASE("a closed mesh is solid whichever way its faces look") {
  for (const OccluderMode mode : {OccluderMode::mesh, OccluderMode::voxels}) {
    const auto outwards = grid_of(turned_box(), mode);
    const auto inwards = grid_of(rebuilt(
                                     turned_box(), [](std::size_t) { return true; }, true),
                                 mode);
    CHECK(outwards->report().warnings.empty());
    CHECK(outwards->count(VoxelState::occupied) > 400);
    test::expect_same_grid(*outwards, *inwards);
  }
}

TEST_CASE("parts of a mesh that overlap are solid where they do") {
  const TriangleMesh box = turned_box();
  const TriangleMesh moved = box.transformed(Pose::from_translation({0.03, 0.01, -0.02}));
  for (const OccluderMode mode : {OccluderMode::mesh, OccluderMode::voxels}) {
    const auto one = grid_of(box, mode), other = grid_of(moved, mode);
    const auto both = grid_of(joined(box, moved), mode);
    CHECK(both->report().warnings.empty());
    std::size_t shared = 0;
    test::for_each_voxel(both->geometry(), [&](const Eigen::Vector3i& voxel) {
      const bool in_one = one->at(voxel) == VoxelState::occupied;
      const bool in_other = other->at(voxel) == VoxelState::occupied;
      CHECK((both->at(voxel) == VoxelState::occupied) == (in_one || in_other));
      shared += in_one && in_other;
    });
    CHECK(shared > 50);
  }
}

TEST_CASE("an open box is solid as far as its winding number says, and a warning names it") {
  // Without its upper face.
  const TriangleMesh closed =
      TriangleMesh::from_box(Box({-0.047, -0.047, 0.043}, {0.047, 0.047, 0.147}));
  const TriangleMesh tray = rebuilt(
      closed,
      [&](std::size_t t) {
        const auto z = [&](int corner) { return closed.corner(t, corner).z(); };
        return z(0) + z(1) + z(2) < 3 * 0.146f;
      },
      false);
  REQUIRE(tray.triangles().size() == 10);
  for (const OccluderMode mode : {OccluderMode::mesh, OccluderMode::voxels}) {
    const auto grid = grid_of(tray, mode);
    REQUIRE(grid->report().warnings.size() == 1);
    CHECK(grid->report().warnings[0].find("object object") != std::string::npos);
    CHECK(grid->report().warnings[0].find("not closed") != std::string::npos);
    const auto at = [&](double x, double y, double z) {
      return grid->at(grid->geometry().voxel_at({x, y, z}).value());
    };
    for (double s = -0.04; s < 0.045; s += 0.005) {
      CHECK(at(s, -0.04, 0.09 + s / 2) == VoxelState::occupied);
      CHECK(at(0.04, s, 0.09 + s / 2) == VoxelState::occupied);
      CHECK(at(s, -s, 0.055) == VoxelState::occupied);
    }
    CHECK(at(0, 0, 0.08) == VoxelState::occupied);
    CHECK(at(0, 0.09, 0.06) == VoxelState::shadow);
    CHECK(at(0.1, 0, 0.1) == VoxelState::free);
    CHECK(grid->count(VoxelState::occupied) <= grid_of(closed, mode)->count(VoxelState::occupied));
  }
}

}  // namespace vantage
