#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "markers/marker_edges.hpp"
#include "markers/marker_homography.hpp"
#include "vantage/raycore/lens.hpp"

namespace vantage::reconstruction::detail {

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

/// A marker's corners as all edges of its print tell them together.
struct RefinedCorners {
  std::array<Eigen::Vector2d, 4> pixels;
  double sigma_px = 0;  ///< of a coordinate: the root mean square of all eight
  double support = 0;   ///< the part of the edges that is where the corners say, 0 to 1
};

/// Fits the print to an image of linear light: the homography that has every edge of the pattern,
/// outside and inside, where the light falls. OpenCV's own refinement, cornerSubPix, is up to
/// 0.4 px off at the corner of a square, even in a perfect image; its outline may run together with
/// a dark neighbour, which the edges inside do not know of. Glow, ink and a camera whose gamma is
/// not sRGB make black grow or shrink: edges on both sides of the black tell how much.
///
/// `start` is off by a pixel or two, and in the image. With a lens (may be null), sides are
/// straight lines through it; without, on the image. Nothing if too few edges (`kSupport`) are
/// where the corners say, or if the corners are uncertain.
std::optional<RefinedCorners> refine_corners(const cv::Mat1f& light,
                                             const std::vector<MarkerEdge>& edges, int cells,
                                             const std::array<Eigen::Vector2d, 4>& start,
                                             const Lens* lens);

}  // namespace vantage::reconstruction::detail
