// Meshes that lost their inside in some program, and have it again.
#include "objects/solid_surface.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <random>

#include "objects/winding_number.hpp"
#include "reference/plain_winding.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/solids.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "volume/same_grid.hpp"
#include "volume/small_grid.hpp"
#include "volume/volume_modes.hpp"

namespace vantage {
namespace {

using volume::detail::Closure;

std::shared_ptr<const StateGrid> grid_with(const TriangleMesh& mesh, const Pose& pose = {}) {
  WorldModel world;
  world.objects.push_back({"thing", std::make_shared<const TriangleMesh>(mesh), pose});
  world.cameras.push_back({"front", test::kFront, nullptr});
  return classify(world, test::small_grid(), test::volume_mode(OccluderMode::mesh, false));
}

TriangleMesh box_mesh() {
  return TriangleMesh::from_box(Box({-0.053, -0.042, 0.021}, {0.051, 0.043, 0.117}));
}

TriangleMesh with_triangles(const TriangleMesh& mesh, const std::vector<Triangle>& more) {
  std::vector<Triangle> all = mesh.triangles();
  all.insert(all.end(), more.begin(), more.end());
  return {mesh.vertices(), all};
}

std::vector<Triangle> turned(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
  return triangles;
}

TriangleMesh without_triangles(const TriangleMesh& mesh, std::initializer_list<std::size_t> gone) {
  std::vector<Triangle> kept;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    if (std::find(gone.begin(), gone.end(), t) == gone.end()) kept.push_back(mesh.triangles()[t]);
  }
  return {mesh.vertices(), kept};
}

/// Every corner of every triangle for itself, moved by up to `distance`.
TriangleMesh shaken(const TriangleMesh& mesh, float distance) {
  std::mt19937 random(3);
  const auto little = [&] { return distance * (float(random() % 2001) / 1000 - 1); };
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    for (int c = 0; c < 3; ++c) {
      vertices.push_back(mesh.corner(t, c) + Eigen::Vector3f(little(), little(), little()));
    }
    const auto n = std::uint32_t(vertices.size());
    triangles.push_back({n - 3, n - 2, n - 1});
  }
  return {vertices, triangles};
}

/// The same grid as the closed mesh, and nothing to warn of.
void expect_as_closed(const TriangleMesh& mesh, const TriangleMesh& closed) {
  const auto grid = grid_with(mesh);
  for (const std::string& warning : grid->report().warnings) FAIL_CHECK(warning);
  CHECK(grid->count(VoxelState::occupied) > 100);
  test::expect_same_grid(*grid, *grid_with(closed));
}

}  // namespace

TEST_CASE("a solid whose faces all look both ways is solid") {
  const TriangleMesh box = box_mesh();
  expect_as_closed(with_triangles(box, turned(box.triangles())), box);
  expect_as_closed(with_triangles({box.vertices(), turned(box.triangles())}, box.triangles()), box);
  const TriangleMesh ball = sphere_solid(0.05).transformed(Pose::from_translation({0, 0, 0.08}));
  expect_as_closed(with_triangles(ball, turned(ball.triangles())), ball);
}

TEST_CASE("a solid with one doubled face, or one face with both orientations, is solid") {
  const TriangleMesh box = box_mesh();
  const std::vector<Triangle> lid = {box.triangles()[2], box.triangles()[3]};
  expect_as_closed(with_triangles(box, turned(lid)), box);
  expect_as_closed(with_triangles(box, lid), box);
  expect_as_closed(with_triangles(box, {lid[0]}), box);
}

TEST_CASE("a wall of double faces within a solid changes nothing") {
  const TriangleMesh box = box_mesh();
  // From edge to edge through the middle.
  const std::vector<Triangle> wall = {{0, 3, 7}, {0, 7, 4}};
  std::vector<Triangle> both = turned(wall);
  both.insert(both.end(), wall.begin(), wall.end());
  expect_as_closed(with_triangles(box, both), box);
}

TEST_CASE("cracks far below the mesh's size close") {
  const TriangleMesh box = box_mesh();
  expect_as_closed(shaken(box, 0), box);
  const auto grid = grid_with(shaken(box, 2e-8f));
  CHECK(grid->report().warnings.empty());
  CHECK(grid->count(VoxelState::occupied) == grid_with(box)->count(VoxelState::occupied));
}

TEST_CASE("a vertex on a neighbour's edge changes nothing") {
  // The lid's front half has a corner in the middle of the edge that the front face has whole.
  TriangleMesh box = box_mesh();
  std::vector<Eigen::Vector3f> vertices = box.vertices();
  vertices.push_back((vertices[4] + vertices[5]) / 2);
  std::vector<Triangle> triangles = without_triangles(box, {2}).triangles();  // {4, 5, 7}
  triangles.push_back({4, 8, 7});
  triangles.push_back({8, 5, 7});
  const TriangleMesh hanging(vertices, triangles);
  CHECK(volume::detail::EdgeBalance(hanging.triangles()).closure() == Closure::open);
  expect_as_closed(hanging, box);
}

TEST_CASE("a scan without a bottom is solid, with a warning that says how certain that is") {
  const TriangleMesh box = box_mesh();
  const TriangleMesh scan = without_triangles(box, {0, 1});
  const auto grid = grid_with(scan), whole = grid_with(box);
  const auto found = double(grid->count(VoxelState::occupied));
  const auto expected = double(whole->count(VoxelState::occupied));
  CHECK(found > 0.9 * expected);
  CHECK(found < 1.02 * expected);
  REQUIRE(grid->report().warnings.size() == 1);
  CHECK(grid->report().warnings[0].find("not closed (4 of its") != std::string::npos);
  CHECK(grid->report().warnings[0].find("ambiguous") != std::string::npos);
  // The same with faces that look both ways.
  const auto doubled = grid_with(with_triangles(scan, turned(scan.triangles())));
  CHECK(doubled->count(VoxelState::occupied) == grid->count(VoxelState::occupied));
}

TEST_CASE("a sheet is the voxels that it touches, on no side more") {
  const std::vector<Eigen::Vector3f> corners = {
      {-0.1f, -0.1f, 0.085f}, {0.1f, -0.1f, 0.085f}, {0.1f, 0.1f, 0.085f}, {-0.1f, 0.1f, 0.085f}};
  const TriangleMesh sheet(corners, {{0, 1, 2}, {0, 2, 3}});
  const auto grid = grid_with(sheet);
  CHECK(grid->report().warnings.size() == 1);
  const auto two_sided = grid_with(with_triangles(sheet, turned(sheet.triangles())));
  test::for_each_voxel(grid->geometry(), [&](const Eigen::Vector3i& voxel) {
    const double z = grid->geometry().centre(voxel).z();
    if (grid->at(voxel) == VoxelState::occupied) CHECK(std::abs(z - 0.085) < 0.0051);
    CHECK(two_sided->at(voxel) == grid->at(voxel));
  });
  CHECK(grid->count(VoxelState::occupied) >= 400);
}

TEST_CASE("remarks about the file reach the report, once for each mesh") {
  const auto mesh = std::make_shared<const TriangleMesh>(box_mesh().with_remarks({"a.stl: odd"}));
  WorldModel world;
  world.objects.push_back({"one", mesh, {}});
  world.objects.push_back({"other", mesh, Pose::from_translation({0.01, 0, 0})});
  world.cameras.push_back({"front", test::kFront, nullptr});
  const auto grid =
      classify(world, test::small_grid(), test::volume_mode(OccluderMode::mesh, false));
  CHECK(grid->report().warnings == std::vector<std::string>{"object one: a.stl: odd"});
}

TEST_CASE("winding numbers of a tree are those of all triangles" *
          doctest::skip(test::kSanitized)) {
  std::mt19937 random(11);
  const auto number = [&] { return double(random() % 20001) / 10000 - 1; };
  for (const TriangleMesh& mesh :
       {duck_solid(1.0), cup_solid(0.5, 1, 0.05),
        without_triangles(sphere_solid(0.8), {0, 1, 2, 9}),
        TriangleMesh(sphere_solid(0.5).vertices(), turned(sphere_solid(0.5).triangles()))}) {
    const volume::detail::WindingNumber tree(mesh.vertices(), mesh.triangles());
    double worst = 0;
    for (int n = 0; n < 400; ++n) {
      const Eigen::Vector3d point(number(), number(), number());
      const double plain = test::plain_winding(mesh.vertices(), mesh.triangles(), point);
      worst = std::max(worst, std::abs(tree.at(point) - plain));
    }
    CAPTURE(mesh.triangles().size());
    CHECK(worst < (test::kAllScenes ? 0.01 : 0.05));  // Clang draws other points
  }
}

TEST_CASE("world coordinates so far out that float shows are refused with the numbers") {
  const auto classify_at = [](double offset, double voxel_size_m) {
    const Pose away = Pose::from_translation({offset, offset, 0});
    WorldModel world;
    world.objects.push_back({"box", std::make_shared<const TriangleMesh>(box_mesh()), away});
    world.cameras.push_back(
        {"front", test::kFront.moved_to(away * test::kFront.T_world_cam()), nullptr});
    const Eigen::Vector3d shift(offset, offset, 0);
    const Box area = test::random_workcell_area();
    return classify(
        world, GridGeometry::covering(Box(area.min() + shift, area.max() + shift), voxel_size_m),
        test::volume_mode(OccluderMode::mesh, false));
  };
  const auto near = classify_at(0, 0.01);
  for (const double offset : {1000.0, 5000.0}) {
    CAPTURE(offset);
    const auto far = classify_at(offset, 0.01);
    for (const VoxelState state : {VoxelState::occupied, VoxelState::free, VoxelState::shadow}) {
      CHECK(double(far->count(state)) ==
            doctest::Approx(double(near->count(state))).epsilon(0.002));
    }
  }
  test::expect_bad_input("work area", "0.0312 m; expected a tenth of the voxel size of 0.01 m",
                         [&] { classify_at(5e5, 0.01); });
  CHECK(classify_at(5e5, 0.4) != nullptr);
}

}  // namespace vantage
