#include "simulator/placement/flat_polygon.hpp"

#include <algorithm>
#include <limits>

namespace vantage {
namespace {

/// Positive if c lies to the left of the line from a to b.
double left_of(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d way = b - a, to = c - a;
  return way.x() * to.y() - way.y() * to.x();
}

FlatPolygon keep_left(const FlatPolygon& polygon, const Eigen::Vector2d& a,
                      const Eigen::Vector2d& b) {
  FlatPolygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = left_of(a, b, p), at_q = left_of(a, b, q);
    if (at_p >= 0) kept.push_back(p);
    if ((at_p >= 0) != (at_q >= 0)) kept.push_back(p + (q - p) * (at_p / (at_p - at_q)));
  }
  return kept;
}

}  // namespace

FlatPolygon hull_of(std::vector<Eigen::Vector2d> points) {
  std::ranges::sort(points, [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  FlatPolygon hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t base = hull.size();
    for (const Eigen::Vector2d& point : points) {
      while (hull.size() >= base + 2 &&
             left_of(hull[hull.size() - 2], hull.back(), point) <= 1e-12) {
        hull.pop_back();
      }
      hull.push_back(point);
    }
    if (!hull.empty()) hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

FlatPolygon common_part(const FlatPolygon& a, const FlatPolygon& b) {
  FlatPolygon common = a;
  for (std::size_t i = 0; i < b.size() && !common.empty(); ++i) {
    common = keep_left(common, b[i], b[(i + 1) % b.size()]);
  }
  return b.size() < 3 ? FlatPolygon() : common;
}

double area_of(const FlatPolygon& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    twice += left_of(polygon[0], polygon[i - 1], polygon[i]);
  }
  return 0.5 * twice;
}

double depth_inside(const FlatPolygon& polygon, const Eigen::Vector2d& point) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (polygon.size() < 3) return -kInfinity;
  double depth = kInfinity;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double length = (b - a).norm();
    // What is shorter comes from rounding, and so does its direction.
    if (length > 1e-7) depth = std::min(depth, left_of(a, b, point) / length);
  }
  return depth;
}

}  // namespace vantage
