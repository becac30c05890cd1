#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"

namespace vantage {

/// Brown–Conrady lens distortion in OpenCV's form and order; k4 to k6 are the rational model's.
struct Distortion {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0, k4 = 0, k5 = 0, k6 = 0;
  bool none() const { return *this == Distortion{}; }
  bool operator==(const Distortion&) const = default;
};

/// What a pixel of a distorted image looks at: the direction (x, y, 1) in the camera's frame.
struct PixelSight {
  Eigen::Vector2d xy;
  Eigen::Matrix2d per_pixel;  ///< its derivatives by (u, v)
};

/// Brown–Conrady distortion and its inverse, which has no closed form. Immutable; thread-safe.
class VANTAGE_API Lens {
 public:
  /// Follows the lines from the principal point to the image's border, which every pixel lies on or
  /// beside, and looks whether the image folds over.
  /// @throws Error bad_input for coefficients that are not finite, or with which a pixel is seen
  /// from no direction or from several; `where` is the place.
  Lens(const Intrinsics& intrinsics, const Distortion& distortion,
       std::string_view where = "distortion");

  const Intrinsics& intrinsics() const noexcept { return k_; }
  const Distortion& distortion() const noexcept { return d_; }

  /// How far from the optical axis the image shows anything, on the plane z = 1. Beyond, nothing is
  /// known of the lens: the polynomial may fold over.
  double reach() const noexcept { return reach_; }

  /// Where on the plane z = 1 the point appears that is at `xy` without the lens (OpenCV's
  /// "Camera Calibration and 3D Reconstruction", the formula of x'' and y'').
  Eigen::Vector2d distort(const Eigen::Vector2d& xy) const;

  /// The derivatives of `distort` by x and y.
  Eigen::Matrix2d slope(const Eigen::Vector2d& xy) const;

  /// The pixel on which a point with z > 0 of the camera's frame appears. Beyond the image's border
  /// it may be anywhere: a polynomial promises nothing there.
  Eigen::Vector2d project(const Eigen::Vector3d& p_cam) const;

  /// The inverse, by Newton's method from a guess (a neighbour's xy) to 1e-12.
  /// @throws Error bad_input if it does not get there.
  PixelSight sight(double u, double v, const Eigen::Vector2d& guess) const;

 private:
  bool undistort(const Eigen::Vector2d& distorted, Eigen::Vector2d& xy) const;
  void follow_line_to(double u, double v);

  Intrinsics k_;
  Distortion d_;
  std::string where_;
  double reach_ = 0;
};

}  // namespace vantage
