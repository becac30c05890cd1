#pragma once

#include <algorithm>
#include <bit>

#include "vantage/planner/advanced/shadow_view.hpp"
#include "vantage/raycore/advanced/scene.hpp"

namespace vantage::planner::detail {

/// The outermost of some pixels of a tile: bit i is pixel (i % 4, i / 4). At least one is set.
inline ShadowBounds bounds_of(PixelTile tile, unsigned pixels) {
  constexpr int kSide = PixelTile::kSide;
  const unsigned columns = (pixels | pixels >> 4 | pixels >> 8 | pixels >> 12) & 0xF;
  const int u = kSide * tile.column, v = kSide * tile.row;
  return {u + std::countr_zero(columns), u + int(std::bit_width(columns)) - 1,
          v + std::countr_zero(pixels) / kSide, v + (int(std::bit_width(pixels)) - 1) / kSide};
}

/// The bounds of both.
inline ShadowBounds joined(const ShadowBounds& a, const ShadowBounds& b) {
  return {std::min(a.left, b.left), std::max(a.right, b.right), std::min(a.top, b.top),
          std::max(a.bottom, b.bottom)};
}

}  // namespace vantage::planner::detail
