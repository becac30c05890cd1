#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "markers/marker_edges.hpp"
#include "markers/marker_homography.hpp"

namespace vantage::detail {

using Vector9d = Eigen::Matrix<double, 9, 1>;

/// One place on an edge. Its residual is linear in the map's entries and in black's growth.
struct EdgeSpot {
  Vector9d slope;      ///< of the residual, by eight entries and the growth
  double offset = 0;   ///< pixels that the edge lies further in than the map says
  double weight = 0;   ///< pixels of edge that it stands for
  bool found = false;  ///< whether there is an edge
};

/// Looks for all edges of a marker where the map says that they are.
std::vector<EdgeSpot> edge_spots(const cv::Mat1f& light, const PrintMap& map,
                                 const std::vector<MarkerEdge>& edges, int cells);

}  // namespace vantage::detail
