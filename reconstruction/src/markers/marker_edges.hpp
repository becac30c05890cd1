#pragma once

#include <Eigen/Core>
#include <vector>

#include "vantage/reconstruction/marker.hpp"

namespace vantage::reconstruction::detail {

/// Where black meets white on a marker, one edge of a cell. On the print, from upper left (-1, -1)
/// to lower right (1, 1), y down; black lies at the right hand of who goes from `from` to `to`.
struct MarkerEdge {
  Eigen::Vector2d from, to;
};

/// All of them: a marker's outline, and those inside. Around the marker it is white.
std::vector<MarkerEdge> marker_edges(const MarkerCells& cells);

}  // namespace vantage::reconstruction::detail
