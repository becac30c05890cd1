#pragma once

#include <Eigen/Core>
#include <span>

namespace vantage::reconstruction::detail {

/// How points spread around their centre: orthogonal axes, a right-handed frame, the direction of
/// the greatest extent first.
struct PrincipalAxes {
  Eigen::Vector3d centre;
  Eigen::Matrix3d axes;  ///< in columns
  Eigen::Vector3d
      extents;  ///< root of the mean square along each axis, falling; to 1e-7 of the first
};

/// Of at least one point, all finite. Thread-safe.
PrincipalAxes principal_axes(std::span<const Eigen::Vector3d> points);

}  // namespace vantage::reconstruction::detail
