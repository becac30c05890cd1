#pragma once

#include <Eigen/Geometry>
#include <array>

#include "simulator/markers/marker_print.hpp"
#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/marker.hpp"

namespace vantage::test {

inline constexpr double kTexel = 0.00025;
inline const Eigen::Vector3f kOrange = {0.9f, 0.5f, 0.1f};
inline constexpr std::array<int, 3> kOrangeTexel = {230, 128, 26};

/// The face of a box that looks along an axis: its frame, with the centre as the origin.
inline Pose face_pose(const Eigen::Vector3d& size, int face, double angle,
                      const Eigen::Vector3d& offset = {0, 0, 0}) {
  const int axis = face / 2;
  const double sign = face % 2 == 0 ? 1 : -1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
  rotation((axis + 1) % 3, 0) = 1;
  rotation((axis + 2) % 3, 1) = sign;
  rotation(axis, 2) = sign;
  const Eigen::Vector3d centre = rotation.col(2) * size[axis] / 2;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return Pose::from_rotation(rotation * turn, centre + rotation * offset);
}

}  // namespace vantage::test
