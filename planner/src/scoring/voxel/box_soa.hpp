#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace vantage::planner::detail {

/// Number of boxes that are tested at once.
inline constexpr std::size_t kBoxLanes = 8;

/// Bounding boxes, one array per number, so that eight are tested at once: filled up to a multiple
/// of that with boxes of no size. Metres.
struct BoxLanes {
  std::size_t size = 0;
  std::vector<double> centre_x, centre_y, centre_z, half_x, half_y, half_z;

  explicit BoxLanes(std::size_t count);
  void set(std::size_t i, const Eigen::Vector3d& min, const Eigen::Vector3d& max);
};

}  // namespace vantage::planner::detail
