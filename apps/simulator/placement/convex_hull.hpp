#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace vantage {

/// From `a` to `b` with its face to the left, seen from outside.
struct HullEdge {
  Eigen::Vector3d a, b;
  std::size_t beyond;  ///< the face on the other side
};

/// A flat, convex polygon. Its edges surround it once, in any order.
struct HullFace {
  Eigen::Vector3d normal;  ///< outwards, unit length
  Eigen::Vector3d centre;  ///< the mean of its corners
  std::vector<HullEdge> edges;
};

/// The faces of the points' convex hull. What is flat to a millionth of their extent is one face,
/// so that corners rounded to floats do not split it.
/// @throws Error bad_input for points in one plane, or fewer than four.
std::vector<HullFace> convex_hull_faces(std::span<const Eigen::Vector3d> points);

}  // namespace vantage
