#pragma once

#include <cmath>
#include <vector>

#include "blocks.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::detail {

/// Where the line along z through the centres of a column of voxels meets a triangle.
struct Crossing {
  int i, j;  ///< the column
  int sign;  ///< +1 where the line enters (the triangle looks down), -1 where it leaves
  double z;  ///< metres from the grid's origin
};

/// All crossings of a mesh's triangles with the columns of a range, triangle by triangle. Which
/// triangles a line meets is exact for the mesh's coordinates; z is rounded.
std::vector<Crossing> scan_line_crossings(const TriangleMesh& mesh, const CellRange& voxels,
                                          double voxel_size_m);

/// The coordinate of a voxel's centre as the rays see it.
inline float centre_coordinate(int index, double voxel_size_m) {
  return float(voxel_size_m * (index + 0.5));
}

/// The first voxel along an axis whose centre is not below a coordinate.
inline int first_centre_above(double coordinate, double voxel_size_m) {
  const double limit = 2e9;
  const double index = std::ceil(coordinate / voxel_size_m - 0.5);
  return int(std::fmin(std::fmax(index, -limit), limit));
}

}  // namespace vantage::detail
