#pragma once

#include <Eigen/Core>
#include <vector>

namespace vantage::test {

/// A box that stands upright, turned around the vertical.
struct StackedBox {
  Eigen::Vector3d size, centre;
  double yaw = 0;
};

/// How much of its weight the worst-held box of a stack lacks, when forces at a grid of points push
/// up as well as they can: 0 for boxes that can be at rest. The forces are found by trying: one
/// after the other is set to what is best with the others as they are. The points lie all over the
/// boxes' undersides and tops, where these are at the height of the floor (z = 0) or of each other;
/// there is no friction.
/// @param grown_m tops and undersides are so much wider on every side; negative: narrower.
double plain_unbalance(const std::vector<StackedBox>& boxes, double grown_m);

}  // namespace vantage::test
