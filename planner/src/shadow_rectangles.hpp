#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::detail {

/// The rectangles of which the shadow's surface is made, across one axis each.
struct ShadowRectangle {
  std::array<std::uint32_t, 4> corners;  ///< around the rectangle
  int axis;                              ///< that it looks along: 0, 1, 2
  double sign;                           ///< 1 if it looks up the axis, -1 if down
  double position_m;                     ///< along the axis
};

struct ShadowRectangles {
  std::vector<Eigen::Vector3d> corners;
  std::vector<ShadowRectangle> list;
  double largest_coordinate_m = 0;

  /// @param faces as `StateGrid::faces` gives them.
  explicit ShadowRectangles(const TriangleMesh& faces);
};

}  // namespace vantage::detail
