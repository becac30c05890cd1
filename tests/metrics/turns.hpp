#pragma once

#include <Eigen/Geometry>
#include <numbers>

#include "vantage/raycore/pose.hpp"
#include "vantage/reconstruction/object_type.hpp"

namespace vantage::test {

inline Pose turn(double angle, const Eigen::Vector3d& axis,
                 const Eigen::Vector3d& shift = {0, 0, 0}) {
  return Pose::from_rotation(Eigen::AngleAxisd(angle, axis).toRotationMatrix(), shift);
}

/// Of a body that looks the same after each quarter turn about its z axis.
inline Symmetries quarter_turns() {
  Symmetries symmetries;
  for (int i = 1; i < 4; ++i) {
    symmetries.discrete.push_back(turn(i * std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
  }
  return symmetries;
}

}  // namespace vantage::test
