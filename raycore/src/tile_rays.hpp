#pragma once

#include "packet.hpp"
#include "pixel_direction.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/scene.hpp"

namespace vantage::detail {

// "GCC unroll 1" before the loops over a packet's lanes: unrolled before the vectoriser comes to
// see them, they would stay scalar, and cost as much as a traversal.

static_assert(PixelTile::kPixels == int(kPacketWidth));

/// The directions of a tile's pixels, as PinholeCamera::pixel_ray has them.
[[gnu::always_inline]] inline void fill_directions(const Intrinsics& k, const PixelRotation& R,
                                                   PixelTile tile, RTCRay16& rays) {
  constexpr int kSide = PixelTile::kSide;
  double across[kSide], down[kSide];
#pragma GCC unroll 1
  for (int i = 0; i < kSide; ++i) {
    across[i] = (kSide * tile.column + i - k.cx) / k.fx;
    down[i] = (kSide * tile.row + i - k.cy) / k.fy;
  }
  double x[kPacketWidth], y[kPacketWidth];
  for (int row = 0; row < kSide; ++row) {
    for (int i = 0; i < kSide; ++i) x[kSide * row + i] = across[i];
    for (int i = 0; i < kSide; ++i) y[kSide * row + i] = down[row];
  }
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) rays.dir_x[i] = float(R.turned<0>(x[i], y[i]));
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) rays.dir_y[i] = float(R.turned<1>(x[i], y[i]));
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) rays.dir_z[i] = float(R.turned<2>(x[i], y[i]));
}

/// @throws Error bad_input unless Embree may see the rays of every tile of the camera.
void check_tiles(const PinholeCamera& camera);

}  // namespace vantage::detail
