#pragma once

#include <Eigen/Core>
#include <array>

namespace vantage::raycore::detail {

using TriangleCorners = std::array<Eigen::Vector3d, 3>;

/// The squared distance of a point and a triangle.
double squared_distance(const Eigen::Vector3d& point, const TriangleCorners& triangle);

/// Whether a triangle is closer than `distance_m` to the solid box of all points with |p| <= half
/// in its own frame, or touches it.
bool closer_to_box_than(double distance_m, const Eigen::Vector3d& half,
                        const TriangleCorners& triangle);

}  // namespace vantage::raycore::detail
