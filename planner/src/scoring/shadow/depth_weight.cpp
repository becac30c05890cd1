#include "scoring/shadow/depth_weight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "vantage/raycore/detail/multiversion.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::planner::detail {
namespace {

constexpr double kMaxPower = 16;

// "GCC unroll 1" before the loops over a tile's pixels: unrolled before the vectoriser comes to see
// them, they would stay scalar.

/// What decides whether a pixel counts.
struct Counted {
  int width, height;
  ObjectId shadow;
  float near_m;
  double per_far;  ///< 1 / far

  Counted(const Intrinsics& image, const DepthRange& range, ObjectId object)
      : width(image.width),
        height(image.height),
        shadow(object),
        near_m(float(range.near_m)),
        per_far(1 / range.far_m) {}
};

/// All bits of `mask` for the pixels that count, none for the others. Misses are infinitely far,
/// but are not the shadow.
[[gnu::always_inline]] inline void mask_of(const Counted& c, PixelTile tile, const TileHits& hits,
                                           std::int32_t* mask) {
#pragma GCC unroll 1
  for (int i = 0; i < PixelTile::kPixels; ++i) {
    const int u = PixelTile::kSide * tile.column + i % PixelTile::kSide,
              v = PixelTile::kSide * tile.row + i / PixelTile::kSide;
    mask[i] = -std::int32_t((u < c.width) & (v < c.height) & (hits.object[i] == c.shadow) &
                            (hits.t[i] >= c.near_m));
  }
}

[[gnu::always_inline]] inline void part_of_far(const Counted& c, const TileHits& hits,
                                               double* part) {
#pragma GCC unroll 1
  for (int i = 0; i < PixelTile::kPixels; ++i) {
    const double d = double(hits.t[i]) * c.per_far;
    part[i] = d < 1 ? d : 1;
  }
}

/// Rounds to integers by adding 2^52, where a double's last bit counts 1: without a conversion,
/// which older instruction sets lack for 64 bits.
[[gnu::always_inline]] inline Score rounded_sum(const double* weights, const std::int32_t* mask) {
  constexpr double kIntegers = 0x1p52;
  Score sum = 0;
#pragma GCC unroll 1
  for (int i = 0; i < PixelTile::kPixels; ++i) {
    const Score rounded = std::bit_cast<Score>(weights[i] * DepthWeight::kOne + kIntegers) -
                          std::bit_cast<Score>(kIntegers);
    sum += rounded & Score(std::int64_t(mask[i]));
  }
  return sum;
}

[[gnu::always_inline]] inline Score sum_whole_power_body(const Counted& c, int power,
                                                         const PixelTile* tiles,
                                                         const TileHits* hits, std::size_t count) {
  Score sum = 0;
  for (std::size_t tile = 0; tile < count; ++tile) {
    alignas(64) std::int32_t mask[PixelTile::kPixels];
    alignas(64) double part[PixelTile::kPixels], weight[PixelTile::kPixels];
    mask_of(c, tiles[tile], hits[tile], mask);
    part_of_far(c, hits[tile], part);
#pragma GCC unroll 1
    for (int i = 0; i < PixelTile::kPixels; ++i) weight[i] = 1;
    for (int factor = 0; factor < power; ++factor) {
#pragma GCC unroll 1
      for (int i = 0; i < PixelTile::kPixels; ++i) weight[i] *= part[i];
    }
    sum += rounded_sum(weight, mask);
  }
  return sum;
}
constexpr Multiversion<sum_whole_power_body> sum_whole_power;

Score sum_any_power(const Counted& c, double power, const PixelTile* tiles, const TileHits* hits,
                    std::size_t count) {
  Score sum = 0;
  for (std::size_t tile = 0; tile < count; ++tile) {
    std::int32_t mask[PixelTile::kPixels];
    double weight[PixelTile::kPixels];
    mask_of(c, tiles[tile], hits[tile], mask);
    part_of_far(c, hits[tile], weight);
#pragma GCC unroll 1
    for (int i = 0; i < PixelTile::kPixels; ++i) {
      weight[i] = mask[i] != 0 ? std::pow(weight[i], power) : 0;
    }
    sum += rounded_sum(weight, mask);
  }
  return sum;
}

}  // namespace

DepthWeight::DepthWeight(double power, const DepthRange& range)
    : power_(power),
      range_(range),
      unit_(std::pow(range.far_m, power) / kOne),
      whole_power_(power == std::floor(power) ? int(power) : -1) {
  range.check("depth range");
  if (power >= 0 && power <= kMaxPower) return;
  throw bad_input("depth power",
                  fmt::format("it is {}; expected a number from 0 to {}", power, kMaxPower));
}

Score DepthWeight::sum(const Intrinsics& image, ObjectId shadow, std::span<const PixelTile> tiles,
                       std::span<const TileHits> hits) const {
  const Counted counted(image, range_, shadow);
  return whole_power_ >= 0
             ? sum_whole_power(counted, whole_power_, tiles.data(), hits.data(), tiles.size())
             : sum_any_power(counted, power_, tiles.data(), hits.data(), tiles.size());
}

WeightBound DepthWeight::bound(double farthest_m) const {
  const double part = std::min(farthest_m / range_.far_m, 1.0), whole = std::floor(power_);
  // (depth / far)^power = (depth / far)^whole · (depth / far)^rest, and no depth is farther.
  const double rest = std::pow(part, power_ - whole);
  return {float(1 / range_.far_m), int(whole), float(rest * kOne),
          float(std::pow(part, power_) * kOne), float(kOne)};
}

std::uint16_t shadow_pixels(const Intrinsics& image, const DepthRange& range, ObjectId shadow,
                            PixelTile tile, const TileHits& hits) {
  std::int32_t mask[PixelTile::kPixels];
  mask_of(Counted(image, range, shadow), tile, hits, mask);
  unsigned bits = 0;
#pragma GCC unroll 1
  for (int i = 0; i < PixelTile::kPixels; ++i) bits |= unsigned(mask[i] & 1) << i;
  return std::uint16_t(bits);
}

}  // namespace vantage::planner::detail
