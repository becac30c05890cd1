#pragma once

#include <cstdint>
#include <span>

#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage::planner::detail {

/// What a pixel at some depth counts at most: factor · (depth / far)^power.
struct WeightBound {
  float per_far;    ///< 1 / far
  int power;        ///< rounded down: `factor` has the rest
  float factor;     ///< in steps of a score
  float uncertain;  ///< what a pixel counts at most of which only `farthest_m` is known
  float anything;   ///< what any pixel counts at most
};

/// What a pixel counts that shows shadow at depth D: (D / far)^power as a multiple of 2^-35, so
/// that sums of them are integers: those of the largest image, 2^28 pixels, fit 64 bits.
class DepthWeight {
 public:
  static constexpr double kOne = 0x1p35;

  /// @throws Error bad_input unless 0 <= power <= 16.
  DepthWeight(double power, const DepthRange& range);

  double power() const noexcept { return power_; }
  const DepthRange& range() const noexcept { return range_; }

  /// What one step is: far^power · 2^-35.
  double unit() const noexcept { return unit_; }

  /// The weights of those pixels of the tiles that lie on the image and show `shadow` in range.
  Score sum(const Intrinsics& image, ObjectId shadow, std::span<const PixelTile> tiles,
            std::span<const TileHits> hits) const;

  /// Weights are at most this, for shadow that is nowhere farther than `farthest_m`.
  WeightBound bound(double farthest_m) const;

 private:
  double power_;
  DepthRange range_;
  double unit_;
  int whole_power_;  ///< -1 for powers that are not
};

/// One bit for each pixel of a tile: whether it lies on the image and shows `shadow` in range.
std::uint16_t shadow_pixels(const Intrinsics& image, const DepthRange& range, ObjectId shadow,
                            PixelTile tile, const TileHits& hits);

}  // namespace vantage::planner::detail
