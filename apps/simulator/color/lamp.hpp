#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "simulator/color/color_sensor.hpp"
#include "vantage/raycore/points.hpp"

namespace vantage {

/// The lamp of a `Lighting` as a square in the world.
class Lamp {
 public:
  explicit Lamp(const Lighting& lighting);

  /// A point of the square: its centre at (0, 0), its corners at ±0.5.
  Eigen::Vector3f at(float x, float y) const { return centre_ + x * side_x_ + y * side_y_; }
  const Eigen::Vector3f& centre() const { return centre_; }
  const Eigen::Vector3f& side_x() const { return side_x_; }
  const Eigen::Vector3f& side_y() const { return side_y_; }

  /// Where it shines to; unit length.
  const Eigen::Vector3f& facing() const { return facing_; }

  /// Light of the lamp on N surfaces if nothing is in between: the integral of cos·cos'/r² over the
  /// square by 2 × 2 Gaussian points, `exposure * lamp_share` at the target. Off by 1 % where the
  /// lamp is as near as it is wide, and with the fourth power of that less farther away.
  void unshadowed(PointsView position, PointsView normal, float* light) const;

 private:
  Eigen::Vector3f centre_, facing_, side_x_, side_y_;
  std::array<Eigen::Vector3f, 4> gaussian_;
  float scale_ = 1;
};

}  // namespace vantage
