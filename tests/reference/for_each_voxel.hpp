#pragma once

#include <Eigen/Core>

#include "vantage/volume/grid_geometry.hpp"

namespace vantage::test {

/// Calls `visit(voxel)` with every voxel of a grid, x slowest, z fastest.
template <class Visit>
void for_each_voxel(const GridGeometry& geometry, const Visit& visit) {
  for (int i = 0; i < geometry.size().x(); ++i)
    for (int j = 0; j < geometry.size().y(); ++j)
      for (int k = 0; k < geometry.size().z(); ++k) visit(Eigen::Vector3i(i, j, k));
}

}  // namespace vantage::test
