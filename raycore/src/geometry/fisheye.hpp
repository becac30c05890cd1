#pragma once

#include <Eigen/Core>

#include "vantage/raycore/lens.hpp"

namespace vantage::detail {

/// OpenCV's fisheye model: what lies at the angle t off the optical axis appears at the radius
/// r(t) = t (1 + k1 t² + k2 t⁴ + k3 t⁶ + k4 t⁸), in its own direction. Kannala and Brandt, "A
/// generic camera model and calibration method for conventional, wide-angle, and fish-eye lenses",
/// 2006.
class Fisheye {
 public:
  explicit Fisheye(const Distortion& d) : k1_(d.k1), k2_(d.k2), k3_(d.k3), k4_(d.k4) {}

  /// The angle, at most `max_angle`, up to which the radius grows.
  double monotone_up_to(double max_angle) const;

  /// As `Lens::distort` and `Lens::slope`.
  Eigen::Vector2d distort(const Eigen::Vector2d& xy) const;
  Eigen::Matrix2d slope(const Eigen::Vector2d& xy) const;

  /// The inverse. @returns false if it lies beyond `max_angle`, up to which the radius has to grow.
  bool undistort(const Eigen::Vector2d& distorted, double max_angle, Eigen::Vector2d& xy) const;

 private:
  double radius(double angle) const;
  double radius_by_angle(double angle) const;
  double angle_at(double radius, double max_angle) const;

  double k1_, k2_, k3_, k4_;
};

}  // namespace vantage::detail
