#pragma once

#include <Eigen/Core>

#include "simulator/color_sensor.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage {

/// What a pixel of a distorted image looks at: the direction (x, y, 1) in the camera's frame.
struct PixelSight {
  Eigen::Vector2d xy;
  Eigen::Matrix2d per_pixel;  ///< its derivatives by (u, v)
};

/// Brown–Conrady distortion and its inverse, which has no closed form. Immutable; thread-safe.
class Lens {
 public:
  /// Follows the lines from the principal point to the image's border, which every pixel lies on or
  /// beside, and looks whether the image folds over.
  /// @throws Error bad_input for coefficients that are not finite, or with which a pixel is seen
  /// from no direction or from several.
  Lens(const Intrinsics& intrinsics, const Distortion& distortion);

  /// Where on the plane z = 1 the point appears that is at `xy` without the lens (OpenCV's
  /// "Camera Calibration and 3D Reconstruction", the formula of x'' and y'').
  Eigen::Vector2d distort(const Eigen::Vector2d& xy) const;

  /// The inverse, by Newton's method from a guess (a neighbour's xy) to 1e-12.
  /// @throws Error bad_input if it does not get there.
  PixelSight sight(double u, double v, const Eigen::Vector2d& guess) const;

 private:
  Eigen::Matrix2d slope(const Eigen::Vector2d& xy) const;
  bool undistort(const Eigen::Vector2d& distorted, Eigen::Vector2d& xy) const;
  void check_line_to(double u, double v) const;

  Intrinsics k_;
  Distortion d_;
};

}  // namespace vantage
