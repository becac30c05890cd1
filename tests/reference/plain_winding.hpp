#pragma once

#include <Eigen/Core>
#include <span>

#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::test {

/// The generalized winding number as it is defined: the sum of all triangles' solid angles, over 4
/// π.
double plain_winding(std::span<const Eigen::Vector3f> vertices, std::span<const Triangle> triangles,
                     const Eigen::Vector3d& point);

}  // namespace vantage::test
