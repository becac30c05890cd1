#include "markers/refine_corners.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "markers/marker_homography.hpp"

namespace vantage::reconstruction::detail {
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

namespace {

using Matrix9d = Eigen::Matrix<double, 9, 9>;

constexpr int kMaxCornerMoves = 8;
constexpr double kSettledPx = 0.002;  ///< a smaller step of the corners is the last one
constexpr double kSupport = 0.6;
constexpr double kMaxSigmaPx = 0.5;
constexpr double kGrowthPx = 0.3;     ///< by which black is expected to grow or shrink
constexpr double kSharpestPx = 0.03;  ///< no edge is known better than this: pixels are squares

/// Normal equations' solution with its information.
struct Step {
  Vector9d by = Vector9d::Zero();
  Matrix9d information = Matrix9d::Zero();  ///< for edges of one pixel's standard deviation
  double sigma = 0;                         ///< of an edge, pixels
};

double residual(const EdgeSpot& spot, const Vector9d& by) {
  return spot.offset - spot.slope.dot(by);
}

/// From the median of the residuals.
double spread(const std::vector<EdgeSpot>& spots, const Vector9d& by) {
  std::vector<double> sizes;
  for (const EdgeSpot& spot : spots) {
    if (spot.found) sizes.push_back(std::abs(residual(spot, by)));
  }
  if (sizes.empty()) return 1;
  const auto middle = sizes.begin() + std::ptrdiff_t(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(1.4826 * *middle, kSharpestPx);
}

/// Least squares in which what is far off counts little (Geman and McClure's weights).
Step solve(const std::vector<EdgeSpot>& spots) {
  Step step;
  for (int round = 0; round < 4; ++round) {
    step.sigma = spread(spots, step.by);
    const double far = 2.5 * step.sigma;
    step.information.setZero();
    step.information(8, 8) = step.sigma * step.sigma / (kGrowthPx * kGrowthPx);
    Vector9d right = Vector9d::Zero();
    for (const EdgeSpot& spot : spots) {
      if (!spot.found) continue;
      const double ratio = residual(spot, step.by) / far;
      const double weight = spot.weight / ((1 + ratio * ratio) * (1 + ratio * ratio));
      step.information += weight * spot.slope * spot.slope.transpose();
      right += weight * spot.offset * spot.slope;
    }
    step.by = step.information.ldlt().solve(right);
    if (!step.by.allFinite()) break;
  }
  return step;
}

/// The part of all edges, by length, that is where the solution has it.
double support(const std::vector<EdgeSpot>& spots, const Step& step) {
  const double near = std::max(3 * step.sigma, 0.2);
  double good = 0, all = 0;
  for (const EdgeSpot& spot : spots) {
    all += spot.weight;
    if (spot.found && std::abs(residual(spot, step.by)) < near) good += spot.weight;
  }
  return all > 0 ? good / all : 0;
}

/// The root mean square of the corners' standard deviations, all eight coordinates.
double corner_sigma(const PrintMap& map, const Step& step) {
  const Eigen::Matrix<double, 8, 8> covariance =
      step.information.inverse().topLeftCorner<8, 8>() * step.sigma * step.sigma;
  double sum = 0;
  for (const Eigen::Vector2d& corner : kPrintCorners) {
    const auto slope = map.slope_by_entries(corner);
    sum += (slope * covariance * slope.transpose()).trace();
  }
  return std::sqrt(sum / 8);
}

/// How far the corner that moves most would move, pixels.
double corner_motion(const PrintMap& map, const Vector9d& by) {
  double most = 0;
  for (const Eigen::Vector2d& corner : kPrintCorners) {
    most = std::max(most, (map.slope_by_entries(corner) * by.head<8>()).norm());
  }
  return most;
}

void move(PrintMap& map, const Vector9d& by) {
  map.h.row(0) += by.head<3>().transpose();
  map.h.row(1) += by.segment<3>(3).transpose();
  map.h.row(2).head<2>() += by.segment<2>(6).transpose();
}

}  // namespace

std::optional<RefinedCorners> refine_corners(const cv::Mat1f& light,
                                             const std::vector<MarkerEdge>& edges, int cells,
                                             const std::array<Eigen::Vector2d, 4>& start,
                                             const Lens* lens) {
  auto map = print_map(start, lens);
  if (!map) return std::nullopt;
  Step step;
  RefinedCorners refined;
  for (int round = 0; round < kMaxCornerMoves; ++round) {
    const auto spots = edge_spots(light, *map, edges, cells);
    step = solve(spots);
    if (!step.by.allFinite()) return std::nullopt;
    refined.support = support(spots, step);
    const double moved = corner_motion(*map, step.by);
    move(*map, step.by);
    if (moved < kSettledPx) break;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const auto pixel = map->at(kPrintCorners[i]);
    if (!pixel) return std::nullopt;
    refined.pixels[i] = *pixel;
  }
  refined.sigma_px = corner_sigma(*map, step);
  const bool sure = refined.support >= kSupport && refined.sigma_px < kMaxSigmaPx;
  return sure ? std::optional(refined) : std::nullopt;
}

}  // namespace vantage::reconstruction::detail
