#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "vantage/raycore/lens.hpp"

namespace vantage::reconstruction::detail {

/// From a marker's print (as MarkerEdge has it) to pixels: a homography, and after it the lens, if
/// that is known. The homography then goes to the plane z = 1.
struct PrintMap {
  Eigen::Matrix3d h;
  const Lens* lens = nullptr;

  /// Nothing where it would be behind the camera.
  std::optional<Eigen::Vector2d> at(const Eigen::Vector2d& print) const;

  /// How the pixel moves with the point on the print.
  Eigen::Matrix2d slope(const Eigen::Vector2d& print) const;

  /// How the pixel moves with the entries of `h`, row by row, but for the last, which is 1.
  Eigen::Matrix<double, 2, 8> slope_by_entries(const Eigen::Vector2d& print) const;
};

/// The print's corners in OpenCV's order: upper left, upper right, lower right, lower left.
inline const std::array<Eigen::Vector2d, 4> kPrintCorners = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

/// The map that takes the print's corners to these pixels; nothing if three are on a line.
std::optional<PrintMap> print_map(const std::array<Eigen::Vector2d, 4>& pixels, const Lens* lens);

}  // namespace vantage::reconstruction::detail
