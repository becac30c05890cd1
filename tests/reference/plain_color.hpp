#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "reference/moller_trumbore.hpp"
#include "reference/random_scene.hpp"
#include "simulator/color/color_sensor.hpp"

namespace vantage::test {

/// Linear light that reaches a pixel. `close_call`: float may see another surface, texel or shadow.
struct PlainLight {
  Eigen::Vector3d light = Eigen::Vector3d::Zero();
  bool close_call = false;
};

/// The slow, obvious twin of simulate_color: one ray after the other against every triangle, in
/// double, the lamp as a grid of 20 × 20 points. No lens and no noise: those have tests of their
/// own.
class PlainColor {
 public:
  PlainColor(const std::vector<SimulatedBody>& bodies, const Lighting& lighting,
             const PinholeCamera& camera);

  /// Of the only sample of a pixel in a picture with one sample per pixel.
  PlainLight single_sample(int u, int v, std::uint64_t seed) const;

  /// The mean of `count` samples that have nothing in common with the simulator's.
  PlainLight mean(int u, int v, int count, Random& random) const;

 private:
  struct Directions {
    Eigen::Vector2d in_pixel;  ///< from its centre, pixels
    Eigen::Vector2d on_lamp;   ///< from its centre, sides
    Eigen::Vector3d sky;       ///< around z = the normal
  };
  struct Point {
    Eigen::Vector3d position, normal, color;
    double depth;
  };

  PlainLight look(double u, double v, const Directions& d) const;
  double lamp_light(const Eigen::Vector3d& position, const Eigen::Vector3d& normal) const;
  Eigen::Vector3d on_lamp(const Eigen::Vector2d& xy) const;
  Eigen::Vector3d color_at(const WorldTriangle& triangle, const Eigen::Vector3d& position,
                           bool& close_call) const;
  PlainLight shade(const Point& point, const Directions& d) const;

  const std::vector<SimulatedBody>& bodies_;
  Lighting lighting_;
  PinholeCamera camera_;
  ReferenceScene scene_;
  Eigen::Vector3d centre_, facing_, side_x_, side_y_;
  double lamp_scale_ = 1;
};

}  // namespace vantage::test
