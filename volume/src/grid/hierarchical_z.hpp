#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vantage::volume::detail {

/// The smallest value over any rectangle of an image's cells, at the cost of a few look-ups: level
/// by level each cell holds the smallest of 2 × 2. The answer may be too small, never too large: it
/// is that of the few cells that cover the rectangle.
class MinPyramid {
 public:
  MinPyramid() = default;
  MinPyramid(int width, int height, std::vector<float> cells) {
    levels_.push_back({width, height, std::move(cells)});
    while (levels_.back().width > 1 || levels_.back().height > 1) levels_.push_back(halved());
  }

  /// Over cells [u0, u1] × [v0, v1], which must lie in the image.
  float min_over(int u0, int u1, int v0, int v1) const {
    std::size_t level = 0;
    while (std::max(u1 - u0, v1 - v0) > 3) {
      u0 >>= 1, u1 >>= 1, v0 >>= 1, v1 >>= 1;
      ++level;
    }
    const Level& cells = levels_[level];
    float smallest = cells.at(u0, v0);
    for (int v = v0; v <= v1; ++v)
      for (int u = u0; u <= u1; ++u) smallest = std::min(smallest, cells.at(u, v));
    return smallest;
  }

 private:
  struct Level {
    int width, height;
    std::vector<float> values;
    float at(int u, int v) const {
      return values[std::size_t(v) * std::size_t(width) + std::size_t(u)];
    }
  };

  Level halved() const {
    const Level& fine = levels_.back();
    Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
    coarse.values.reserve(std::size_t(coarse.width) * std::size_t(coarse.height));
    for (int v = 0; v < coarse.height; ++v) {
      const int below = std::min(2 * v + 1, fine.height - 1);
      for (int u = 0; u < coarse.width; ++u) {
        const int right = std::min(2 * u + 1, fine.width - 1);
        coarse.values.push_back(std::min({fine.at(2 * u, 2 * v), fine.at(right, 2 * v),
                                          fine.at(2 * u, below), fine.at(right, below)}));
      }
    }
    return coarse;
  }

  std::vector<Level> levels_;
};

}  // namespace vantage::volume::detail
