#include "scoring/voxel/box_soa.hpp"

namespace vantage::planner::detail {

BoxLanes::BoxLanes(std::size_t count) : size(count) {
  const std::size_t filled = (count + kBoxLanes - 1) / kBoxLanes * kBoxLanes;
  for (auto* lanes : {&centre_x, &centre_y, &centre_z, &half_x, &half_y, &half_z}) {
    lanes->resize(filled);
  }
}

void BoxLanes::set(std::size_t i, const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
  const Eigen::Vector3d centre = 0.5 * (min + max), half = 0.5 * (max - min);
  centre_x[i] = centre.x(), centre_y[i] = centre.y(), centre_z[i] = centre.z();
  half_x[i] = half.x(), half_y[i] = half.y(), half_z[i] = half.z();
}

}  // namespace vantage::planner::detail
