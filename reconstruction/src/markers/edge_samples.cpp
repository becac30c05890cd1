#include "markers/edge_samples.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vantage::detail {
namespace {

constexpr double kDarkest = 0.02;    ///< fall of light that is an edge
constexpr double kSpacingPx = 0.25;  ///< of light along an edge's normal

/// Bilinear, and the image's edge goes on forever.
double light_at(const cv::Mat1f& light, const Eigen::Vector2d& p) {
  const double u = std::clamp(p.x(), 0.0, light.cols - 1.001);
  const double v = std::clamp(p.y(), 0.0, light.rows - 1.001);
  const int column = int(u), row = int(v);
  const double s = u - column, t = v - row;
  const float* upper = light.ptr<float>(row) + column;
  const float* lower = light.ptr<float>(row + 1) + column;
  return (1 - t) * ((1 - s) * double(upper[0]) + s * double(upper[1])) +
         t * ((1 - s) * double(lower[0]) + s * double(lower[1]));
}

/// How far inside of `p` white turns to black: the mean of the fall of light, weighted by itself. A
/// blur does not move it. Nothing where light does not fall.
std::optional<double> edge_offset(const cv::Mat1f& light, const Eigen::Vector2d& p,
                                  const Eigen::Vector2d& inwards, double reach) {
  const int steps = int(std::ceil(reach / kSpacingPx));
  const double step = reach / steps;
  const double first = light_at(light, p - reach * inwards);
  double before = first, moment = 0;
  for (int i = -steps; i < steps; ++i) {
    const double after = light_at(light, p + (i + 1) * step * inwards);
    moment += (before - after) * (i + 0.5) * step;
    before = after;
  }
  const double fall = first - before;
  if (fall < kDarkest) return std::nullopt;
  const double offset = moment / fall;
  if (std::abs(offset) > 0.9 * reach) return std::nullopt;
  return offset;
}

/// Looks for one edge at a spacing of about a pixel, away from its ends: corners are round.
void measure(const cv::Mat1f& light, const PrintMap& map, const MarkerEdge& edge, double cell,
             std::vector<EdgeSpot>& spots) {
  const Eigen::Vector2d tangent = edge.to - edge.from, inwards(-tangent.y(), tangent.x());
  const double length = (map.slope((edge.from + edge.to) / 2) * tangent).norm();
  const int count = std::clamp(int(std::lround(0.6 * length)), 2, 12);
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector2d print = edge.from + (0.2 + 0.6 * (k + 0.5) / count) * tangent;
    const auto pixel = map.at(print);
    if (!pixel) continue;
    const Eigen::Matrix2d slope = map.slope(print);
    const Eigen::Vector2d along = (slope * tangent).normalized(), normal(-along.y(), along.x());
    // Within the cells on both sides. The white around a marker may be less than a cell wide.
    const double reach =
        std::clamp(0.4 * cell * normal.dot(slope * inwards.normalized()), 1.2, 4.0);
    EdgeSpot spot;
    spot.weight = 0.6 * length / count;
    spot.slope << map.slope_by_entries(print).transpose() * normal, -1;
    if (const auto offset = edge_offset(light, *pixel, normal, reach)) {
      spot.offset = *offset;
      spot.found = true;
    }
    spots.push_back(spot);
  }
}

}  // namespace

std::vector<EdgeSpot> edge_spots(const cv::Mat1f& light, const PrintMap& map,
                                 const std::vector<MarkerEdge>& edges, int cells) {
  std::vector<EdgeSpot> spots;
  for (const MarkerEdge& edge : edges) measure(light, map, edge, 2.0 / cells, spots);
  return spots;
}

}  // namespace vantage::detail
