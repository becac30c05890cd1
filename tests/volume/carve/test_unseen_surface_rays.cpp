// The two ways to subtract what was seen from the work area, held together: what rays meet in a
// UnobservedSpace, and the exported mesh.

#include <doctest/doctest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "reference/noisy_depth.hpp"
#include "reference/random_workcell.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/advanced/unobserved_space.hpp"
#include "vantage/volume/advanced/carve.hpp"
#include "vantage/volume/advanced/shadow_filter.hpp"
#include "vantage/volume/advanced/visibility.hpp"

namespace vantage {
namespace {

using test::Random;

constexpr double kVoxel = 0.006;

/// What two cameras saw of a random work cell.
std::vector<VisibilityMesh> seen_lattices(std::uint32_t seed, Random& random, bool with_noise) {
  const auto scene = test::scene_with_foreign_box(test::random_workcell(seed), random);
  std::vector<VisibilityMesh> lattices;
  for (int i = 0; i < 2; ++i) {
    const PinholeCamera camera = test::random_observer(random);
    const auto depth = with_noise ? test::noisy_depth(*scene, camera, random)
                                  : std::make_shared<const DepthImage>(scene->render_depth(camera));
    if (auto lattice =
            visibility_lattice({camera, depth}, test::random_workcell_area(), StereoNoise(), {})) {
      lattices.push_back(std::move(*lattice));
    }
  }
  return lattices;
}

/// In pixels; `same_depth` and `near_the_mesh`: to the mesh's resolution, `closely`: well within
/// it.
struct PixelTally {
  std::size_t rays = 0, hits = 0, same_outcome = 0, same_depth = 0, closely = 0, near_the_mesh = 0;
};

/// Compares what the pixels of a view meet.
void compare(const UnobservedSpace& space, const TriangleMesh& mesh, const PinholeCamera& view,
             PixelTally& tally) {
  SceneBuilder builder;
  builder.add_mesh(mesh);
  const auto surface = builder.build();
  const double resolution = std::sqrt(3.0) * kVoxel;
  const Intrinsics& k = view.intrinsics();
  for (int row = 0; row < k.height / PixelTile::kSide; ++row) {
    for (int column = 0; column < k.width / PixelTile::kSide; ++column) {
      const PixelTile tile{std::uint16_t(column), std::uint16_t(row)};
      UnseenHits unseen;
      TileHits hits;
      space.first_unseen(view, {&tile, 1}, {&unseen, 1});
      surface->first_hits(view, {&tile, 1}, {&hits, 1});
      for (int i = 0; i < PixelTile::kPixels; ++i) {
        const PixelRay ray = view.pixel_ray(PixelTile::kSide * column + i % PixelTile::kSide,
                                            PixelTile::kSide * row + i / PixelTile::kSide);
        const double by_rays = double(unseen.t[i]), by_mesh = double(hits.t[i]);
        ++tally.rays;
        tally.same_outcome += std::isfinite(by_rays) == std::isfinite(by_mesh);
        if (!std::isfinite(by_rays)) continue;
        ++tally.hits;
        const double apart_m = std::abs(by_rays - by_mesh) * ray.direction.norm();
        tally.same_depth += apart_m < resolution;
        tally.closely += apart_m < 0.3 * kVoxel;
        const Eigen::Vector3d met = ray.origin + by_rays * ray.direction;
        tally.near_the_mesh += surface->closer_than(resolution, met);
      }
    }
  }
}

void expect_agreement(const PixelTally& tally, double same_outcome, double same_depth) {
  CAPTURE(tally.rays);
  CAPTURE(tally.hits);
  CHECK(tally.hits > tally.rays / 20);
  // Rays along a surface may pass it or not, and slivers thinner than a voxel are not in the mesh.
  CHECK(double(tally.same_outcome) > same_outcome * double(tally.rays));
  CHECK(double(tally.near_the_mesh) > (test::kAllScenes ? 0.99 : 0.985) * double(tally.hits));
  CHECK(double(tally.same_depth) > same_depth * double(tally.hits));
  CHECK(double(tally.closely) > 0.8 * double(tally.hits));
}

PinholeCamera random_view(Random& random) {
  const PinholeCamera observer = test::random_observer(random);
  return {{160, 120, 150, 150, 79.5, 59.5}, observer.T_world_cam(), {0.05, 3}};
}

/// One view of each random cell. @param filtered noisy images, of which a filter left something;
/// else ideal ones, and all that they left unseen.
PixelTally compare_cells(bool filtered) {
  PixelTally tally;
  const GridGeometry geometry = GridGeometry::covering(test::random_workcell_area(), kVoxel);
  for (std::uint32_t seed = 0; seed < test::scene_count(12); ++seed) {
    Random random(seed);
    const std::vector<VisibilityMesh> lattices = seen_lattices(seed, random, filtered);
    const PinholeCamera view = random_view(random);
    if (filtered) {
      const auto opened = morphological_open(*carve(lattices, geometry, {}), 1);
      const TriangleMesh shell = shell_around_shadow(*opened);
      compare(UnobservedSpace(lattices, geometry.box(), &shell), unseen_surface(lattices, *opened),
              view, tally);
    } else {
      compare(UnobservedSpace(lattices, geometry.box()), unseen_surface(lattices, geometry), view,
              tally);
    }
  }
  return tally;
}

}  // namespace

TEST_CASE("rays first meet the unseen where the exported mesh is, within its resolution") {
  expect_agreement(compare_cells(false), 0.97, 0.9);
}

TEST_CASE("the same of noisy images with what the filter leaves of the unseen") {
  // Slivers are what the filter takes away: a mesh without it has the same outcome for 0.977.
  expect_agreement(compare_cells(true), 0.985, test::kAllScenes ? 0.93 : 0.91);
}

}  // namespace vantage
