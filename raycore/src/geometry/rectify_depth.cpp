#include "vantage/raycore/rectify_depth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

/// Where the lens shows what a pinhole has at a pixel; nothing where the lens does not reach.
std::optional<Eigen::Vector2d> place_in_lens(const Lens& lens, double u, double v) {
  const Intrinsics& k = lens.intrinsics();
  const Eigen::Vector3d direction((u - k.cx) / k.fx, (v - k.cy) / k.fy, 1);
  if (direction.head<2>().norm() > lens.reach()) return std::nullopt;
  return lens.project(direction);
}

}  // namespace

DepthImage rectify_depth(const DepthImage& depth, const Lens& lens, std::string_view where) {
  const Intrinsics& k = lens.intrinsics();
  if (depth.width() != k.width || depth.height() != k.height) {
    throw bad_input(std::string(where),
                    fmt::format("the depth image is {}×{}, the calibration is for {}×{} pixels",
                                depth.width(), depth.height(), k.width, k.height));
  }
  DepthImage rectified(depth.width(), depth.height());
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const auto from = place_in_lens(lens, u, v);
      if (!from) continue;
      const double x = std::round(from->x()), y = std::round(from->y());
      const bool inside = x >= 0 && y >= 0 && x < depth.width() && y < depth.height();
      if (inside) rectified.set(u, v, depth.at(int(x), int(y)));
    }
  }
  return rectified;
}

double max_displacement_px(const Lens& lens) {
  constexpr int kSteps = 32;  // along each side: distortion is smooth
  const Intrinsics& k = lens.intrinsics();
  double largest_px = 0;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Eigen::Vector2d pixel((k.width - 1) * double(i) / kSteps,
                                  (k.height - 1) * double(j) / kSteps);
      const auto moved = place_in_lens(lens, pixel.x(), pixel.y());
      if (moved) largest_px = std::max(largest_px, (*moved - pixel).norm());
    }
  }
  return largest_px;
}

}  // namespace vantage
