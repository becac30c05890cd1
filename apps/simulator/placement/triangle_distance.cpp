#include "simulator/placement/triangle_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "vantage/raycore/detail/segment_distance.hpp"

namespace vantage {
namespace {

using Eigen::Vector3d;

// Squared, of a point and a triangle's plane; infinite if the foot is not in the triangle, where an
// edge is as near.
double squared_face_distance(const Vector3d& point, const TriangleCorners& triangle) {
  const Vector3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d edge = triangle[(i + 1) % 3] - triangle[i];
    if (normal.cross(edge).dot(point - triangle[i]) < 0) {
      return std::numeric_limits<double>::infinity();
    }
  }
  const double height = normal.dot(point - triangle[0]);
  return height * height / normal.squaredNorm();
}

}  // namespace

double distance_of_uncrossed(const TriangleCorners& a, const TriangleCorners& b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min({least, squared_face_distance(a[i], b), squared_face_distance(b[i], a)});
    for (std::size_t j = 0; j < 3; ++j) {
      least = std::min(least, squared_segment_distance(a[i], a[(i + 1) % 3] - a[i], b[j],
                                                       b[(j + 1) % 3] - b[j]));
    }
  }
  return std::sqrt(least);
}

}  // namespace vantage
