#include "mesh/triangulate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace vantage::raycore::detail {
namespace {

using Point = Eigen::Vector2d;

/// Twice the area of a triangle, positive if it is counter-clockwise.
double signed_area(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// The corners in the plane, seen so that the polygon runs counter-clockwise: along the axis that
/// is nearest to its normal, which leaves coordinates as they are.
std::vector<Point> flattened(std::span<const std::uint32_t> corners,
                             std::span<const Eigen::Vector3f> vertices) {
  const Eigen::Vector3d origin = vertices[corners[0]].cast<double>();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d a = vertices[corners[i]].cast<double>() - origin;
    const Eigen::Vector3d b = vertices[corners[(i + 1) % corners.size()]].cast<double>() - origin;
    normal += a.cross(b);  // Newell: twice the area vector
  }
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  std::vector<Point> points;
  points.reserve(corners.size());
  for (const std::uint32_t corner : corners) {
    const Eigen::Vector3d p = vertices[corner].cast<double>() - origin;
    points.emplace_back(p[u], p[v]);
  }
  return points;
}

bool is_fan(const std::vector<Point>& p) {
  for (std::size_t i = 2; i < p.size(); ++i) {
    if (!(signed_area(p[0], p[i - 1], p[i]) > 0)) return false;
  }
  return true;
}

/// A polygon from which ears are clipped: a ring of what is left of its corners.
class PolygonRing {
 public:
  PolygonRing(const std::vector<Point>& points, std::uint64_t& tests)
      : p_(points),
        next_(points.size()),
        before_(points.size()),
        left_(points.size()),
        tests_(tests) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      next_[i] = (i + 1) % points.size();
      before_[i] = (i + points.size() - 1) % points.size();
    }
  }

  /// The corners of the triangles, three by three; false if it takes too many tests.
  bool clip(std::vector<std::size_t>& ears) {
    std::size_t corner = 0, passed = 0;
    while (left_ > 3) {
      if (tests_ == 0) return false;
      const bool any = passed >= left_;  // no ear all around: the polygon crosses itself
      if (!any && !is_ear(corner)) {
        corner = next_[corner];
        ++passed;
        continue;
      }
      cut(corner, ears);
      // Not the neighbour: fans of slivers around one corner come of that.
      corner = next_[next_[corner]];
      passed = 0;
    }
    ears.insert(ears.end(), {before_[corner], corner, next_[corner]});
    return true;
  }

 private:
  void cut(std::size_t corner, std::vector<std::size_t>& ears) {
    ears.insert(ears.end(), {before_[corner], corner, next_[corner]});
    next_[before_[corner]] = next_[corner];
    before_[next_[corner]] = before_[corner];
    --left_;
  }

  /// Whether the triangle at a corner has an area and holds no other corner, not even on its sides:
  /// a corner that lies on the cut would be left hanging there. Corners at the place of one of the
  /// triangle's own do not count: bridges to holes pass twice through them.
  bool is_ear(std::size_t corner) {
    const Point &a = p_[before_[corner]], &b = p_[corner], &c = p_[next_[corner]];
    take_test();
    if (!(signed_area(a, b, c) > 0)) return false;
    for (std::size_t i = next_[next_[corner]]; i != before_[corner]; i = next_[i]) {
      take_test();
      const Point& q = p_[i];
      if (signed_area(a, b, q) < 0 || signed_area(b, c, q) < 0 || signed_area(c, a, q) < 0) {
        continue;
      }
      if (q != a && q != b && q != c) return false;
    }
    return true;
  }

  void take_test() { tests_ -= tests_ > 0 ? 1 : 0; }

  const std::vector<Point>& p_;
  std::vector<std::size_t> next_, before_;
  std::size_t left_;
  std::uint64_t& tests_;
};

}  // namespace

bool triangulate(std::span<const std::uint32_t> corners, std::span<const Eigen::Vector3f> vertices,
                 std::uint64_t& tests, std::vector<Triangle>& triangles) {
  const std::vector<Point> points = flattened(corners, vertices);
  if (is_fan(points)) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
      triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
    return true;
  }
  std::vector<std::size_t> ears;
  if (!PolygonRing(points, tests).clip(ears)) return false;
  for (std::size_t i = 0; i < ears.size(); i += 3) {
    triangles.push_back({corners[ears[i]], corners[ears[i + 1]], corners[ears[i + 2]]});
  }
  return true;
}

}  // namespace vantage::raycore::detail
