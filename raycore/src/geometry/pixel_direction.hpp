#pragma once

#include <Eigen/Core>

namespace vantage::raycore::detail {

/// Turns the directions (x, y, 1) of a camera's pixels into the world. Written out, so that it
/// comes out the same to the bit for one pixel and for sixteen: Eigen's products add in an order of
/// their own.
struct PixelRotation {
  double r[9];

  explicit PixelRotation(const Eigen::Matrix3d& R_world_cam) {
    for (int row = 0; row < 3; ++row)
      for (int col = 0; col < 3; ++col) r[3 * row + col] = R_world_cam(row, col);
  }
  template <int kRow>
  double turned(double x, double y) const {
    return r[3 * kRow] * x + r[3 * kRow + 1] * y + r[3 * kRow + 2];
  }
};

}  // namespace vantage::raycore::detail
