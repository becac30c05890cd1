#pragma once

#include <Eigen/Core>
#include <vector>

#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::test {

/// The convex hull of a few points no four of which lie in one plane: all triples with every other
/// point on one side.
TriangleMesh plain_hull(const std::vector<Eigen::Vector3f>& points);

}  // namespace vantage::test
