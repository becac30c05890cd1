#pragma once

#include <Eigen/Core>

#include "vantage/volume/state_grid.hpp"

namespace vantage::planner::detail {

/// The mean of the shadow's voxels; the grid's middle if there are none.
/// @param centres the grid's of the shadow.
Eigen::Vector3d middle_of_shadow(const StateGrid& grid, PointsView centres);

}  // namespace vantage::planner::detail
