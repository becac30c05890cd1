#pragma once

#include <vector>

#include "vantage/raycore/advanced/unobserved_space.hpp"

namespace vantage::test {

inline std::vector<PixelTile> image_tiles(const Intrinsics& k) {
  std::vector<PixelTile> tiles;
  for (int row = 0; row < (k.height + 3) / 4; ++row) {
    for (int column = 0; column < (k.width + 3) / 4; ++column) {
      tiles.push_back({std::uint16_t(column), std::uint16_t(row)});
    }
  }
  return tiles;
}

/// What one pixel of a camera showed.
struct UnseenPixel {
  int u, v;
  PixelRay ray;
  double t, end, facing;
  std::uint32_t source;

  Eigen::Vector3d at(double t_ray) const { return ray.origin + t_ray * ray.direction; }
};

/// All pixels of a camera's tiles, those outside the image, too.
inline std::vector<UnseenPixel> unseen_pixels(const UnobservedSpace& space,
                                              const PinholeCamera& camera) {
  const std::vector<PixelTile> tiles = image_tiles(camera.intrinsics());
  std::vector<UnseenHits> hits(tiles.size());
  space.first_unseen(camera, tiles, hits);
  std::vector<UnseenPixel> pixels;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    for (int lane = 0; lane < PixelTile::kPixels; ++lane) {
      const int u = PixelTile::kSide * tiles[i].column + lane % PixelTile::kSide;
      const int v = PixelTile::kSide * tiles[i].row + lane / PixelTile::kSide;
      pixels.push_back({u, v, camera.pixel_ray(u, v), double(hits[i].t[lane]),
                        double(hits[i].end[lane]), double(hits[i].facing[lane]),
                        hits[i].source[lane]});
    }
  }
  return pixels;
}

}  // namespace vantage::test
