#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "raycore/seen_tiles.hpp"
#include "reference/random_scene.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

PinholeCamera random_small_camera(Random& random) {
  const Eigen::Vector3d target = random.in_cube(0.3);
  return {{int(random.below(70)) + 1, int(random.below(60)) + 1, random.uniform(20, 90),
           random.uniform(20, 90), random.uniform(5, 40), random.uniform(5, 30)},
          Pose::looking_at(target + random.uniform(0.2, 2) * random.direction(), target),
          {0.1, random.below(2) == 0 ? 1e6 : random.uniform(1, 3)}};
}

/// The directions of a tile's pixels, one by one.
Points directions_of(const PinholeCamera& camera, PixelTile tile) {
  Points directions;
  for (int i = 0; i < 16; ++i) {
    const PixelRay ray = camera.pixel_ray(4 * tile.column + i % 4, 4 * tile.row + i / 4);
    directions.push_back(ray.direction.cast<float>());
  }
  return directions;
}

}  // namespace

TEST_CASE("a tile's hits are those of its pixel rays in one packet") {
  std::size_t hits = 0, misses = 0;
  for (std::uint32_t seed = 0; seed < scene_count(30); ++seed) {
    CAPTURE(seed);
    const RandomScene random = random_scene(seed, seed % 3 == 0);
    Random camera_random(seed);
    const PinholeCamera camera = random_small_camera(camera_random);
    const std::vector<PixelTile> tiles = image_tiles(camera.intrinsics());
    std::vector<TileHits> lean(tiles.size());
    random.scene->first_hits(camera, tiles, lean);
    Hits full;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      random.scene->closest_hits(camera.centre().cast<float>(), directions_of(camera, tiles[i]),
                                 full);
      for (std::size_t lane = 0; lane < 16; ++lane) {
        // The lean query ends at the far depth; rays that end early may move the others' last bit.
        const float far_m = float(camera.range().far_m);
        const bool in_range = full.hit(lane) && full.t[lane] <= far_m;
        if (in_range && lean[i].object[lane] != kNoObject) {
          const float tolerance = far_m > 10 ? 0 : 1e-6f * full.t[lane];
          CHECK(std::abs(lean[i].t[lane] - full.t[lane]) <= tolerance);
        }
        CHECK((lean[i].object[lane] != kNoObject) == in_range);
        CHECK(std::isinf(lean[i].t[lane]) == !in_range);
        ++(in_range ? hits : misses);
      }
    }
  }
  CHECK(hits > enough(5000));
  CHECK(misses > enough(5000));
}

TEST_CASE("a tile's hits do not depend on the other tiles of the batch") {
  for (std::uint32_t seed = 0; seed < scene_count(30); ++seed) {
    CAPTURE(seed);
    const RandomScene random = random_scene(seed, seed % 3 == 0);
    Random camera_random(seed + 1000);
    const PinholeCamera camera = random_small_camera(camera_random);
    const std::vector<PixelTile> tiles = image_tiles(camera.intrinsics());
    std::vector<TileHits> together(tiles.size()), backwards(tiles.size());
    random.scene->first_hits(camera, tiles, together);
    const std::vector<PixelTile> reversed(tiles.rbegin(), tiles.rend());
    random.scene->first_hits(camera, reversed, backwards);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      TileHits alone;
      random.scene->first_hits(camera, {&tiles[i], 1}, {&alone, 1});
      CHECK(std::memcmp(&alone, &together[i], sizeof alone) == 0);
      CHECK(std::memcmp(&alone, &backwards[tiles.size() - 1 - i], sizeof alone) == 0);
    }
  }
}

TEST_CASE("tiles are refused for a camera that Embree must not see") {
  SceneBuilder builder;
  builder.add_box(Box({-1, -1, -1}, {1, 1, 1}));
  const auto scene = builder.build();
  const std::vector<PixelTile> tiles(3);
  std::vector<TileHits> hits(3);
  const auto trace = [&](double fx, const Eigen::Vector3d& centre) {
    scene->first_hits({{8, 8, fx, 100, 4, 4}, Pose::from_translation(centre)}, tiles, hits);
  };
  trace(100, {0, 0, 5});
  expect_bad_input("camera", "fx is 1e-300", [&] { trace(1e-300, {0, 0, 5}); });
  expect_bad_input("camera", "centre is [0, 2000000000, 0]", [&] { trace(100, {0, 2e9, 0}); });
  hits.resize(2);
  expect_bad_input("batch", "hits has 2 elements; expected 3", [&] { trace(100, {0, 0, 5}); });
}
