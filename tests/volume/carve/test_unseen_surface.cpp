#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <utility>

#include "reference/noisy_depth.hpp"
#include "reference/random_workcell.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/volume/advanced/carve.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "vantage/volume/advanced/shadow_filter.hpp"
#include "vantage/volume/advanced/visibility.hpp"
#include "volume/make_grid.hpp"
#include "volume/mesh_measures.hpp"

namespace vantage {
namespace {

using test::Random;

const Box kSmallArea({-0.1, -0.12, 0}, {0.1, 0.12, 0.15});

/// A camera above the work area's middle that looks down.
PinholeCamera above(double height) {
  return {
      {100, 100, 100, 100, 49.5, 49.5}, Pose::looking_at({0.001, 0, height}, {0, 0, 0}), {0.1, 3}};
}

/// One cell over all of the image, at one depth.
VisibilityMesh flat(const PinholeCamera& camera, float depth) {
  return {camera, {0, 99}, {0, 99}, {depth, depth, depth, depth}};
}

bool unseen(std::span<const VisibilityMesh> lattices, const Box& box, const Eigen::Vector3d& p) {
  if (!box.contains(p)) return false;
  for (const VisibilityMesh& lattice : lattices) {
    if (lattice.sees(p)) return false;
  }
  return true;
}

Box box_of(const GridGeometry& geometry) {
  return Box(geometry.origin(), geometry.corner(geometry.size()));
}

/// Of some two thousand corners, the part that has unseen space within `reach` on the one side, and
/// something else on the other.
double corners_at_the_border(const TriangleMesh& mesh, std::span<const VisibilityMesh> lattices,
                             const Box& box, double reach) {
  std::size_t count = 0, asked = 0;
  for (std::size_t i = 0; i < mesh.vertices().size(); i += 1 + mesh.vertices().size() / 2000) {
    const Eigen::Vector3f& corner = mesh.vertices()[i];
    ++asked;
    bool any_in = false, any_out = false;
    for (int n = 0; n < 4 * 27; ++n) {
      const Eigen::Vector3d step(n % 3 - 1, n / 3 % 3 - 1, n / 9 % 3 - 1);
      const Eigen::Vector3d at =
          corner.cast<double>() + reach * (n / 27) / 3 * step.stableNormalized();
      (unseen(lattices, box, at) ? any_in : any_out) = true;
    }
    count += any_in && any_out;
  }
  return double(count) / double(asked);
}

double carved_m3(std::span<const VisibilityMesh> lattices, const GridGeometry& geometry) {
  return carve(lattices, geometry, {})->volume_m3(VoxelState::shadow);
}

/// The voxels whose centres are inside the mesh are those that carving leaves.
void expect_same_sides(const TriangleMesh& mesh, std::span<const VisibilityMesh> lattices,
                       const GridGeometry& geometry) {
  const auto solid = std::make_shared<const TriangleMesh>(mesh);
  const auto inside = classify({{{"unseen", solid, {}}}, {}, {}}, geometry);
  CHECK(inside->report().warnings.empty());
  const auto carved = carve(lattices, geometry, {});
  std::size_t differences = 0;
  test::for_each_voxel(geometry, [&](const Eigen::Vector3i& voxel) {
    differences +=
        (inside->at(voxel) == VoxelState::occupied) != (carved->at(voxel) == VoxelState::shadow);
  });
  CHECK(differences == 0);
}

void expect_surface(const TriangleMesh& mesh, std::span<const VisibilityMesh> lattices,
                    const GridGeometry& geometry, double expected_m3, double tolerance) {
  CHECK(test::closed(mesh));
  CHECK(mesh.dropped_degenerate() == 0);
  expect_same_sides(mesh, lattices, geometry);
  CHECK(std::abs(test::volume_m3(mesh) / expected_m3 - 1) < tolerance);
  const double voxel = geometry.voxel_size_m();
  const Box box = box_of(geometry);
  // Within a voxel's diagonal all of them, and most of them well within a voxel.
  CHECK(corners_at_the_border(mesh, lattices, box, std::sqrt(3.0) * voxel) == 1);
  CHECK(corners_at_the_border(mesh, lattices, box, 0.3 * voxel) > 0.85);
}

std::vector<VisibilityMesh> random_lattices(std::uint32_t seed, double subpixel_px) {
  Random random(seed);
  const auto scene = test::scene_with_foreign_box(test::random_workcell(seed), random);
  std::vector<VisibilityMesh> lattices;
  for (const int step : {2, 5}) {
    const PinholeCamera camera = test::random_observer(random);
    VisibilityOptions options;
    options.step_px = step;
    const StereoNoise noise{.subpixel_px = subpixel_px};
    const auto depth = subpixel_px > 0
                           ? test::noisy_depth(*scene, camera, random)
                           : std::make_shared<const DepthImage>(scene->render_depth(camera));
    if (auto lattice =
            visibility_lattice({camera, depth}, test::random_workcell_area(), noise, options)) {
      lattices.push_back(std::move(*lattice));
    }
  }
  return lattices;
}

/// Whether there is shadow in a voxel, or in one of its 26 neighbours.
bool near_shadow(const StateGrid& grid, const Eigen::Vector3i& voxel) {
  for (int n = 0; n < 27; ++n) {
    const Eigen::Vector3i at = voxel + Eigen::Vector3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
    const bool in_grid =
        (at.array() >= 0).all() && (at.array() < grid.geometry().size().array()).all();
    if (in_grid && grid.at(at) == VoxelState::shadow) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("without lattices the unseen surface is the box, to the rounding of floats") {
  const GridGeometry geometry = GridGeometry::covering(kSmallArea, 0.01);
  const TriangleMesh mesh = unseen_surface({}, geometry);
  CHECK(test::closed(mesh));
  // Edges are cut off by half a voxel at the most.
  CHECK(test::volume_m3(mesh) / geometry.volume_m3() > 0.97);
  CHECK(test::volume_m3(mesh) / geometry.volume_m3() <= 1 + 1e-6);
  const Box box = box_of(geometry);
  std::size_t on_faces = 0;
  for (const Eigen::Vector3f& v : mesh.vertices()) {
    const Eigen::Vector3d p = v.cast<double>();
    const double inside = std::min((p - box.min()).minCoeff(), (box.max() - p).minCoeff());
    CHECK(inside > -1e-6);
    on_faces += std::abs(inside) < 1e-6;
  }
  CHECK(double(on_faces) > 0.75 * double(mesh.vertices().size()));
}

TEST_CASE("the unseen surface lies on a lattice's planes to a small part of a voxel") {
  const PinholeCamera camera = above(0.6);
  const std::vector<VisibilityMesh> lattices{flat(camera, 0.537f)};  // at a height of 63 mm
  const GridGeometry geometry = GridGeometry::covering(kSmallArea, 0.005);
  const TriangleMesh mesh = unseen_surface(lattices, geometry);
  expect_surface(mesh, lattices, geometry, 0.2 * 0.24 * 0.063, 0.015);
  // The camera looks straight down within the box: nothing but the plane is left on top.
  std::size_t on_plane = 0;
  for (const Eigen::Vector3f& v : mesh.vertices()) {
    const auto seen = camera.project(v.cast<double>());
    REQUIRE(seen);
    const bool inner = std::abs(v.x()) < 0.085 && std::abs(v.y()) < 0.105 && v.z() > 0.02f;
    if (!inner) continue;
    CHECK(std::abs(seen->depth - 0.537) < 0.02 * 0.005);
    ++on_plane;
  }
  CHECK(on_plane > 200);
}

TEST_CASE("the unseen surface has the walls of holes and of the image's border") {
  const PinholeCamera camera = above(0.5);
  VisibilityMesh lattice{camera, {20, 40, 60, 80}, {10, 50, 90}, std::vector<float>(12, 1.0f)};
  lattice.depth[0] = DepthImage::kUnknown;  // the first cell is a hole
  const std::vector<VisibilityMesh> lattices{lattice};
  const GridGeometry geometry = GridGeometry::covering(kSmallArea, 0.005);
  const TriangleMesh mesh = unseen_surface(lattices, geometry);
  expect_surface(mesh, lattices, geometry, carved_m3(lattices, geometry), 0.01);
  // Along the walls, corners are at the columns and rows where the seen space ends.
  std::size_t inner = 0, on_walls = 0;
  for (const Eigen::Vector3f& v : mesh.vertices()) {
    const double inside = std::min((v.cast<double>() - kSmallArea.min()).minCoeff(),
                                   (kSmallArea.max() - v.cast<double>()).minCoeff());
    if (inside < 0.01) continue;
    const auto at = camera.project(v.cast<double>());
    REQUIRE(at);
    const double pixel_m = at->depth / 100;
    double nearest_px = 1e9;
    for (const double u : {20.0, 40.0, 80.0})
      nearest_px = std::min(nearest_px, std::abs(at->u - u));
    for (const double r : {10.0, 50.0, 90.0})
      nearest_px = std::min(nearest_px, std::abs(at->v - r));
    ++inner;
    on_walls += nearest_px * pixel_m < 0.1 * 0.005;
  }
  CHECK(inner > 300);
  CHECK(double(on_walls) > 0.9 * double(inner));
}

TEST_CASE("the unseen surface of what cameras saw is closed, near the truth, and as large") {
  for (std::uint32_t seed = 0; seed < test::scene_count(6); ++seed) {
    CAPTURE(seed);
    const auto lattices = random_lattices(seed, seed % 2 == 0 ? 0 : 0.08);
    const GridGeometry geometry = GridGeometry::covering(test::random_workcell_area(), 0.006);
    expect_surface(unseen_surface(lattices, geometry), lattices, geometry,
                   carved_m3(lattices, geometry), 0.05);
  }
}

TEST_CASE("of the unseen, the surface has what a filter left") {
  const GridGeometry geometry = GridGeometry::covering(test::random_workcell_area(), 0.006);
  for (std::uint32_t seed = 0; seed < test::scene_count(6); ++seed) {
    CAPTURE(seed);
    const auto lattices = random_lattices(seed, 0.08);
    const auto carved = carve(lattices, geometry, {});
    // A filter that removes nothing changes nothing.
    const TriangleMesh plain = unseen_surface(lattices, geometry);
    const TriangleMesh same = unseen_surface(lattices, *morphological_open(*carved, 0));
    CHECK(same.vertices() == plain.vertices());
    CHECK(same.triangles() == plain.triangles());

    const auto opened = morphological_open(*carved, 2);
    const TriangleMesh mesh = unseen_surface(lattices, *opened);
    CHECK(test::closed(mesh));
    // Inside are the voxels' centres that carving and the filter leave, and of what carving leaves
    // those next to them.
    const auto solid = std::make_shared<const TriangleMesh>(mesh);
    const auto inside = classify({{{"unseen", solid, {}}}, {}, {}}, geometry);
    std::size_t differences = 0, left = 0, removed = 0;
    test::for_each_voxel(geometry, [&](const Eigen::Vector3i& voxel) {
      const bool counts = carved->at(voxel) == VoxelState::shadow && near_shadow(*opened, voxel);
      differences += (inside->at(voxel) == VoxelState::occupied) != counts;
      left += counts;
      removed += carved->at(voxel) == VoxelState::shadow && !counts;
    });
    CHECK(differences == 0);
    CHECK(left > 0);
    CHECK(removed > 0);
  }
}

TEST_CASE(
    "a lattice that sees all leaves no surface, threads make no difference, errors are told") {
  const GridGeometry geometry =
      GridGeometry::covering(Box({-0.05, -0.05, 0}, {0.05, 0.05, 0.1}), 0.01);
  const std::vector<VisibilityMesh> all{flat(above(0.6), 2)};
  CHECK(unseen_surface(all, geometry).empty());

  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const auto lattices = random_lattices(3, 0.08);
  const auto at_threads = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] {
      return unseen_surface(lattices, GridGeometry::covering(test::random_workcell_area(), 0.006));
    });
  };
  const TriangleMesh one = at_threads(1), many = at_threads(8);
  CHECK(one.vertices() == many.vertices());
  CHECK(one.triangles() == many.triangles());

  const std::vector<VisibilityMesh> bad{flat(above(0.6), -1)};
  test::expect_bad_input("depth", "", [&] { unseen_surface(bad, geometry); });
}

}  // namespace vantage
