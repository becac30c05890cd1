#pragma once

#include <Eigen/Core>

#include "vantage/raycore/pose.hpp"

namespace vantage::reconstruction::detail {

/// cross_matrix(a) * b is a × b.
inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// What a small step (t, r) of a pose, as Matrix6d has it, is for a frame that is carried along
/// `arm` from the pose's origin, both in the parent frame: its origin moves by t + r × arm.
inline Matrix6d carried_along(const Eigen::Vector3d& arm) {
  Matrix6d by_pose = Matrix6d::Identity();
  by_pose.block<3, 3>(0, 3) = -cross_matrix(arm);
  return by_pose;
}

}  // namespace vantage::reconstruction::detail
