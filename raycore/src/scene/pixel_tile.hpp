#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "geometry/pixel_direction.hpp"
#include "scene/ray_packet.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage::raycore::detail {

struct Pixel {
  int u;
  int v;
};

/// Pixels are traced in tiles of 4×4, a packet each: such rays stay together in the BVH. A band is
/// four rows of the image, cut into its tiles.
inline constexpr int kTileSide = 4;

inline std::size_t band_count(int height) {
  return std::size_t(height + kTileSide - 1) / kTileSide;
}

/// The pixels of a band, tile by tile.
inline std::vector<Pixel> pixels_of_band(const Intrinsics& k, int band) {
  const int top = band * kTileSide;
  const int bottom = std::min(top + kTileSide, k.height);
  std::vector<Pixel> pixels;
  pixels.reserve(std::size_t(k.width) * std::size_t(bottom - top));
  for (int left = 0; left < k.width; left += kTileSide) {
    for (int v = top; v < bottom; ++v) {
      for (int u = left; u < std::min(left + kTileSide, k.width); ++u) pixels.push_back({u, v});
    }
  }
  return pixels;
}

// "GCC unroll 1" before the loops over a packet's lanes: unrolled before the vectoriser comes to
// see them, they would stay scalar, and cost as much as a traversal.

static_assert(PixelTile::kPixels == int(kPacketWidth));

// Directions are made a few packets ahead of Embree: it loads them whole, and would wait for those
// that have only just been stored in parts.
constexpr std::size_t kTilesAhead = 16;

/// The directions of a tile's pixels, as PinholeCamera::pixel_ray has them.
struct alignas(64) TileRays {
  float x[kPacketWidth], y[kPacketWidth], z[kPacketWidth];
};

/// Where a few tiles' columns and rows are in the image plane at depth 1, four of each for a tile.
struct TilePlaces {
  alignas(64) double x[kTilesAhead * PixelTile::kSide], y[kTilesAhead * PixelTile::kSide];

  [[gnu::always_inline]] inline void set(const Intrinsics& k, const PixelTile* tiles, int count) {
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < PixelTile::kSide; ++j)
        x[PixelTile::kSide * i + j] = PixelTile::kSide * tiles[i].column + j;
      set_row(k, tiles, i);
    }
#pragma GCC unroll 1
    for (int i = 0; i < PixelTile::kSide * count; ++i) x[i] = (x[i] - k.cx) / k.fx;
  }

  /// Neighbours are often in one row; divisions are what takes long here.
  [[gnu::always_inline]] inline void set_row(const Intrinsics& k, const PixelTile* tiles, int i) {
    double* const here = y + PixelTile::kSide * i;
    if (i > 0 && tiles[i].row == tiles[i - 1].row) {
      std::copy(here - PixelTile::kSide, here, here);
    } else {
      for (int j = 0; j < PixelTile::kSide; ++j)
        here[j] = (PixelTile::kSide * tiles[i].row + j - k.cy) / k.fy;
    }
  }
};

/// One coordinate of a tile's directions, as PixelRotation::turned has it to the bit. Products are
/// one for each column and one for each row.
template <int kAxis>
[[gnu::always_inline]] inline void fill_axis(const PixelRotation& R, const double* x,
                                             const double* y, float* direction) {
  const double at_depth = R.r[3 * kAxis + 2];
  double across[PixelTile::kSide];
#pragma GCC unroll 1
  for (int j = 0; j < PixelTile::kSide; ++j) across[j] = R.r[3 * kAxis] * x[j];
  for (int i = 0; i < PixelTile::kSide; ++i) {
    const double down = R.r[3 * kAxis + 1] * y[i];
#pragma GCC unroll 1
    for (int j = 0; j < PixelTile::kSide; ++j)
      direction[PixelTile::kSide * i + j] = float(across[j] + down + at_depth);
  }
}

/// The directions of one tile's pixels.
[[gnu::always_inline]] inline void fill_directions(const Intrinsics& k, const PixelRotation& R,
                                                   PixelTile tile, float* x, float* y, float* z) {
  TilePlaces place;
  place.set(k, &tile, 1);
  fill_axis<0>(R, place.x, place.y, x);
  fill_axis<1>(R, place.x, place.y, y);
  fill_axis<2>(R, place.x, place.y, z);
}

/// @throws Error bad_input unless Embree may see the rays of every tile of the camera.
void check_tiles(const PinholeCamera& camera);

}  // namespace vantage::raycore::detail
