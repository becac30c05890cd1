#pragma once

#include "reference/random_workcell.hpp"
#include "vantage/volume/grid_geometry.hpp"

namespace vantage::test {

/// Voxels of 1 cm in the work area of random workcells.
inline GridGeometry small_grid() {
  return GridGeometry::covering(random_workcell_area(), 0.01);
}

/// Looks at the middle of that area from its front.
inline const PinholeCamera kFront({160, 120, 150, 150, 79.5, 59.5},
                                  Pose::looking_at({0, -0.5, 0.3}, {0, 0, 0.08}), {0.1, 2});

}  // namespace vantage::test
