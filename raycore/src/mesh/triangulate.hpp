#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::raycore::detail {

/// Cuts a polygon into `corners.size() - 2` triangles of its own corners, which have its sense of
/// rotation, and adds them. A polygon for which a fan around its first corner is right (any convex
/// one) becomes that fan; another one has its ears clipped (Meisters, "Polygons have ears", 1975).
/// Both see the polygon along its normal after Newell, so that it need not be quite flat. A corner
/// on the straight line between its neighbours becomes a corner of a triangle with an area, if
/// there is any such triangle.
/// @param corners three or more indices of `vertices`.
/// @param tests how many tests of a corner against a triangle it may take, less those that it took.
/// @returns false, with nothing added, if they do not suffice.
bool triangulate(std::span<const std::uint32_t> corners, std::span<const Eigen::Vector3f> vertices,
                 std::uint64_t& tests, std::vector<Triangle>& triangles);

}  // namespace vantage::raycore::detail
