#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "grid/blocks.hpp"
#include "objects/mesh_instance.hpp"

namespace vantage::volume::detail {

/// Where the line along z through the centres of a column of voxels meets a triangle.
struct Crossing {
  int i, j;  ///< the column
  int sign;  ///< +1 where the line enters (the triangle looks down), -1 where it leaves
  double z;  ///< metres from the grid's origin
};

/// Column by column, upwards.
inline bool crosses_earlier(const Crossing& a, const Crossing& b) {
  return std::tie(a.i, a.j, a.z) < std::tie(b.i, b.j, b.z);
}

/// All crossings of a mesh's triangles with the columns of a range, triangle by triangle. Which
/// triangles a line meets is exact for the mesh's coordinates; z is rounded.
std::vector<Crossing> scan_line_crossings(const PlacedTriangles& mesh, const CellRange& voxels,
                                          double voxel_size_m);

/// Rounded down, saturated well inside the range of int; without the function call that it takes on
/// processors of before SSE 4.1.
inline int floor_to_int(double value) {
  const double limited = std::min(std::max(value, -1e9), 1e9);
  const int truncated = int(limited);
  return truncated - int(limited < truncated);
}

/// The first voxel along an axis whose centre is not below a coordinate.
inline int first_centre_above(double coordinate, double voxel_size_m) {
  return -floor_to_int(0.5 - coordinate / voxel_size_m);
}

}  // namespace vantage::volume::detail
