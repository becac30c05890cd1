#pragma once

#include <algorithm>
#include <cmath>

#include "vantage/raycore/camera.hpp"

namespace vantage::planner::detail {

/// The same field of view on an image of another width.
inline Intrinsics scaled(const Intrinsics& k, int width) {
  const double su = double(width) / k.width;
  const int height = std::max(1, int(std::lround(k.height * su)));
  const double sv = double(height) / k.height;
  return {width, height, k.fx * su, k.fy * sv, (k.cx + 0.5) * su - 0.5, (k.cy + 0.5) * sv - 0.5};
}

}  // namespace vantage::planner::detail
