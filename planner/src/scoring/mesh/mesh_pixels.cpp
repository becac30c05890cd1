#include "scoring/mesh/mesh_pixels.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "scoring/shadow/depth_weight.hpp"
#include "vantage/raycore/detail/multiversion.hpp"

namespace vantage::planner::detail {
namespace {

struct CountedUnseen {
  int width, height;
  float near_m, far_m;
};

// "GCC unroll 1", here and below, as in depth_weight.cpp: so that the loops become vectors.
[[gnu::always_inline]] inline void mask_of(const CountedUnseen& c, PixelTile tile,
                                           const UnseenHits& unseen, const TileHits& known,
                                           std::int32_t* mask) {
#pragma GCC unroll 1
  for (int i = 0; i < PixelTile::kPixels; ++i) {
    const int u = PixelTile::kSide * tile.column + i % PixelTile::kSide,
              v = PixelTile::kSide * tile.row + i / PixelTile::kSide;
    mask[i] = -std::int32_t((u < c.width) & (v < c.height) & (unseen.t[i] >= c.near_m) &
                            (unseen.t[i] <= c.far_m) & (unseen.t[i] < known.t[i]));
  }
}

[[gnu::always_inline]] inline Score sum_of_body(const CountedUnseen& c, int whole_power,
                                                double power, const MeshTiles& tiles) {
  constexpr double kIntegers = 0x1p52;  // where a double's last bit counts 1
  const double per_far = 1 / double(c.far_m);
  Score sum = 0;
  for (std::size_t tile = 0; tile < tiles.tiles.size(); ++tile) {
    const UnseenHits& unseen = tiles.unseen[tile];
    alignas(64) std::int32_t mask[PixelTile::kPixels];
    alignas(64) double part[PixelTile::kPixels], weight[PixelTile::kPixels];
    mask_of(c, tiles.tiles[tile], unseen, tiles.known[tile], mask);
#pragma GCC unroll 1
    for (int i = 0; i < PixelTile::kPixels; ++i) {
      const double d = double(unseen.t[i]) * per_far;
      part[i] = d < 1 ? d : 1;
      weight[i] = 1 - double(unseen.facing[i]);
    }
    for (int factor = 0; factor < whole_power; ++factor) {
#pragma GCC unroll 1
      for (int i = 0; i < PixelTile::kPixels; ++i) weight[i] *= part[i];
    }
    for (int i = 0; whole_power < 0 && i < PixelTile::kPixels; ++i) {
      weight[i] *= std::pow(part[i], power);
    }
#pragma GCC unroll 1
    for (int i = 0; i < PixelTile::kPixels; ++i) {
      const Score rounded = std::bit_cast<Score>(weight[i] * DepthWeight::kOne + kIntegers) -
                            std::bit_cast<Score>(kIntegers);
      sum += rounded & Score(std::int64_t(mask[i]));
    }
  }
  return sum;
}
constexpr Multiversion<sum_of_body> sum_of;

}  // namespace

MeshPixels::MeshPixels(const Intrinsics& image, const DepthRange& range, double power)
    : width_(image.width),
      height_(image.height),
      near_m_(float(range.near_m)),
      far_m_(float(range.far_m)),
      power_(power),
      whole_power_(power == std::floor(power) ? int(power) : -1) {}

Score MeshPixels::sum(const MeshTiles& tiles) const {
  return sum_of({width_, height_, near_m_, far_m_}, whole_power_, power_, tiles);
}

Score MeshPixels::most(double farthest_m) const {
  const double part = std::min(farthest_m / double(far_m_), 1.0);
  return Score(std::ceil(std::pow(part, power_) * (1 + 1e-6) * DepthWeight::kOne)) + 1;
}

std::uint16_t MeshPixels::shown(const MeshTiles& tiles, std::size_t i, float max_facing) const {
  std::int32_t mask[PixelTile::kPixels];
  mask_of({width_, height_, near_m_, far_m_}, tiles.tiles[i], tiles.unseen[i], tiles.known[i],
          mask);
  unsigned bits = 0;
  for (int p = 0; p < PixelTile::kPixels; ++p) {
    bits |= unsigned(mask[p] & 1 & int(tiles.unseen[i].facing[p] <= max_facing)) << p;
  }
  return std::uint16_t(bits);
}

namespace {

/// What the kernel needs of a view.
struct ViewLimits {
  int width, height;
  double near_m, far_m;
};

[[gnu::always_inline]] inline Score volume_of_body(const ViewLimits& view, const MeshTiles& tiles) {
  constexpr double kIntegers = 0x1p52;  // where a double's last bit counts 1
  const double per_far = 1 / view.far_m;
  Score sum = 0;
  for (std::size_t tile = 0; tile < tiles.tiles.size(); ++tile) {
    const PixelTile at = tiles.tiles[tile];
    const UnseenHits& unseen = tiles.unseen[tile];
    const TileHits& known = tiles.known[tile];
// "GCC unroll 1" as in depth_weight.cpp: so that the loop becomes vectors.
#pragma GCC unroll 1
    for (int i = 0; i < PixelTile::kPixels; ++i) {
      const int u = PixelTile::kSide * at.column + i % PixelTile::kSide,
                v = PixelTile::kSide * at.row + i / PixelTile::kSide;
      const float its_end = unseen.end[i], object = known.t[i];
      const double met = double(unseen.t[i]), ends = double(object < its_end ? object : its_end);
      const double begin = met < view.near_m ? view.near_m : met;
      const double end = ends < view.far_m ? ends : view.far_m;
      const bool counts = (u < view.width) & (v < view.height) & (begin < end);
      const double d = counts ? begin * per_far : 0, e = counts ? end * per_far : 0;
      const double weight = (1 - double(unseen.facing[i])) * (e * e * e - d * d * d);
      sum += std::bit_cast<Score>(weight * DepthWeight::kOne + kIntegers) -
             std::bit_cast<Score>(kIntegers);
    }
  }
  return sum;
}
constexpr Multiversion<volume_of_body> volume_of;

}  // namespace

Score unseen_volume(const PinholeCamera& view, const MeshTiles& tiles) {
  const Intrinsics& k = view.intrinsics();
  return volume_of({k.width, k.height, view.range().near_m, view.range().far_m}, tiles);
}

}  // namespace vantage::planner::detail
