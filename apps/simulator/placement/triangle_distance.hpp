#pragma once

#include <Eigen/Core>
#include <array>

namespace vantage {

using TriangleCorners = std::array<Eigen::Vector3d, 3>;

/// The least distance of two triangles that do not cross: no edge of one goes through the inside of
/// the other. It is then that of two edges, or of a corner and a face. Crossing triangles get the
/// distance of their nearest edges and corners, not 0.
double distance_of_uncrossed(const TriangleCorners& a, const TriangleCorners& b);

}  // namespace vantage
