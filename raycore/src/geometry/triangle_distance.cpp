// Ericson, "Real-Time Collision Detection", 2005: sections 5.1.5 (point and triangle) and 5.2.9
// (box and triangle).

#include "geometry/triangle_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "vantage/raycore/detail/segment_distance.hpp"

namespace vantage::raycore::detail {
namespace {

using Eigen::Vector3d;

/// Separating axes: the box's three, the triangle's normal, the nine cross products of edges.
bool apart(const Vector3d& half, const TriangleCorners& corners) {
  const Vector3d &a = corners[0], &b = corners[1], &c = corners[2];
  const auto separates = [&](const Vector3d& axis) {
    const double pa = axis.dot(a), pb = axis.dot(b), pc = axis.dot(c);
    const double reach = axis.cwiseAbs().dot(half) * (1 + 1e-12);
    return std::min({pa, pb, pc}) > reach || std::max({pa, pb, pc}) < -reach;
  };
  for (int i = 0; i < 3; ++i) {
    if (separates(Vector3d::Unit(i))) return true;
  }
  if (separates((b - a).cross(c - a))) return true;
  for (const Vector3d& edge : {Vector3d(b - a), Vector3d(c - b), Vector3d(a - c)}) {
    for (int i = 0; i < 3; ++i) {
      if (separates(Vector3d::Unit(i).cross(edge))) return true;
    }
  }
  return false;
}

/// Whether an edge of the box is closer to an edge of the triangle than that, squared.
bool edges_closer(double squared, const Vector3d& half, const TriangleCorners& triangle) {
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d along = 2 * half[axis] * Vector3d::Unit(axis);
    for (int side = 0; side < 4; ++side) {
      Vector3d begin = -half;
      if (side & 1) begin[(axis + 1) % 3] = half[(axis + 1) % 3];
      if (side & 2) begin[(axis + 2) % 3] = half[(axis + 2) % 3];
      for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d edge = triangle[(i + 1) % 3] - triangle[i];
        if (squared_segment_distance(begin, along, triangle[i], edge) < squared) return true;
      }
    }
  }
  return false;
}

/// The same for two bodies that do not touch: it is a corner of one and a face of the other that
/// are nearest, or two edges.
bool features_closer(double squared, const Vector3d& half, const TriangleCorners& triangle) {
  for (const Vector3d& corner : triangle) {
    if ((corner - corner.cwiseMax(-half).cwiseMin(half)).squaredNorm() < squared) return true;
  }
  for (int i = 0; i < 8; ++i) {
    const Vector3d signs(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    if (squared_distance(signs.cwiseProduct(half), triangle) < squared) return true;
  }
  return edges_closer(squared, half, triangle);
}

}  // namespace

double squared_distance(const Vector3d& point, const TriangleCorners& triangle) {
  const auto& [a, b, c] = triangle;
  const Vector3d ab = b - a, ac = c - a, ap = point - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return ap.squaredNorm();
  const Vector3d bp = point - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return bp.squaredNorm();
  const Vector3d cp = point - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return cp.squaredNorm();
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return (ap - d1 / (d1 - d3) * ab).squaredNorm();
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ap - d2 / (d2 - d6) * ac).squaredNorm();
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)).squaredNorm();
  }
  const double scale = 1 / (va + vb + vc);
  return (ap - vb * scale * ab - vc * scale * ac).squaredNorm();
}

bool closer_to_box_than(double distance_m, const Vector3d& half, const TriangleCorners& triangle) {
  if (apart(half + Vector3d::Constant(distance_m), triangle)) return false;
  if (distance_m == 0 || !apart(half, triangle)) return true;
  return features_closer(distance_m * distance_m, half, triangle);
}

}  // namespace vantage::raycore::detail
