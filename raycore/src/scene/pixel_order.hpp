#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "vantage/raycore/camera.hpp"

namespace vantage::detail {

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

}  // namespace vantage::detail
