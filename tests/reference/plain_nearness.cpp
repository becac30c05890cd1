#include "reference/plain_nearness.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "reference/plain_distance.hpp"
#include "support/non_finite.hpp"

namespace vantage::test {
namespace {

using Eigen::Vector3d;

// That of the plane where the foot is on the triangle, that of the nearest edge elsewhere.
double to_triangle(const Vector3d& p, const WorldTriangle& triangle) {
  const auto& c = triangle.corners;
  const Vector3d normal = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
  if (triangle.cross(p, normal).margin_m >= 0) return triangle.distance_to_plane(p);
  return std::min({segment_distance(p, c[0], c[1]), segment_distance(p, c[1], c[2]),
                   segment_distance(p, c[2], c[0])});
}

template <class Distance>
double least(const ReferenceScene& scene, ObjectId object, const Distance& distance) {
  double result = kInfinity;
  for (const WorldTriangle& triangle : scene.triangles()) {
    if (object == kNoObject || triangle.object == object) {
      result = std::min(result, distance(triangle));
    }
  }
  return result;
}

}  // namespace

double nearest_surface(const ReferenceScene& scene, const Vector3d& point, ObjectId object) {
  return least(scene, object, [&](const WorldTriangle& t) { return to_triangle(point, t); });
}

double nearest_surface(const ReferenceScene& scene, const Box& box, const Pose& T_world_box,
                       ObjectId object) {
  ReferenceScene faces;
  faces.add(TriangleMesh::from_box(Box(-0.5 * box.size(), 0.5 * box.size())),
            T_world_box * Pose::from_translation(box.centre()), 0);
  const Pose T_box_world = T_world_box.inverse();
  return least(scene, object, [&](const WorldTriangle& triangle) {
    if (box.contains(T_box_world * triangle.corners[0])) return 0.0;
    double nearest = kInfinity;
    for (const WorldTriangle& face : faces.triangles()) {
      nearest = std::min(nearest, triangle_distance(face, triangle));
    }
    return nearest;
  });
}

bool surrounded(const ReferenceScene& scene, const Vector3d& point) {
  std::map<ObjectId, double> solid_angles;
  for (const WorldTriangle& triangle : scene.triangles()) {
    const Vector3d a = triangle.corners[0] - point, b = triangle.corners[1] - point,
                   c = triangle.corners[2] - point;
    solid_angles[triangle.object] +=
        2 * std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                              b.dot(c) * a.norm() + c.dot(a) * b.norm());
  }
  return std::any_of(solid_angles.begin(), solid_angles.end(), [](const auto& entry) {
    return std::abs(entry.second) > 2 * std::numbers::pi;
  });
}

}  // namespace vantage::test
