#include "reference/plain_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "reference/moller_trumbore.hpp"

namespace vantage::test {
namespace {

using Eigen::Vector3d;

// The distance to a segment is convex along the other one: thirds are cut off its worse end.
double between_segments(Vector3d a, Vector3d b, const Vector3d& c, const Vector3d& d) {
  for (int i = 0; i < 80; ++i) {
    const Vector3d left = (2 * a + b) / 3, right = (a + 2 * b) / 3;
    (segment_distance(left, c, d) < segment_distance(right, c, d) ? b : a) =
        segment_distance(left, c, d) < segment_distance(right, c, d) ? right : left;
  }
  return segment_distance((a + b) / 2, c, d);
}

bool edge_crosses(const WorldTriangle& edges, const WorldTriangle& face) {
  for (int i = 0; i < 3; ++i) {
    const Vector3d a = edges.corners[i], b = edges.corners[(i + 1) % 3];
    const Crossing crossing = face.cross(a, b - a);
    if (crossing.margin_m >= 0 && crossing.t >= 0 && crossing.t <= 1) return true;
  }
  return false;
}

// Along the normal, where it meets the triangle; its border is for the edges.
double corner_to_face(const WorldTriangle& corners, const WorldTriangle& face) {
  const Vector3d normal =
      (face.corners[1] - face.corners[0]).cross(face.corners[2] - face.corners[0]).normalized();
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& corner : corners.corners) {
    if (face.cross(corner, normal).margin_m >= 0) {
      least = std::min(least, face.distance_to_plane(corner));
    }
  }
  return least;
}

struct Bounded {
  WorldTriangle triangle;
  Eigen::AlignedBox3d box;
};

std::vector<Bounded> in_world(const TriangleMesh& mesh, const Pose& T_world_mesh) {
  ReferenceScene scene;
  scene.add(mesh, T_world_mesh, 0);
  std::vector<Bounded> result;
  for (const WorldTriangle& triangle : scene.triangles()) {
    result.push_back({triangle, {}});
    for (const Vector3d& corner : triangle.corners) result.back().box.extend(corner);
  }
  return result;
}

}  // namespace

double segment_distance(const Vector3d& point, const Vector3d& a, const Vector3d& b) {
  const double t = std::clamp((point - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (point - (a + t * (b - a))).norm();
}

double triangle_distance(const WorldTriangle& a, const WorldTriangle& b) {
  if (edge_crosses(a, b) || edge_crosses(b, a)) return 0;
  double least = std::min(corner_to_face(a, b), corner_to_face(b, a));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      least = std::min(least, between_segments(a.corners[i], a.corners[(i + 1) % 3], b.corners[j],
                                               b.corners[(j + 1) % 3]));
    }
  }
  return least;
}

double surface_distance(const TriangleMesh& a, const Pose& T_world_a, const TriangleMesh& b,
                        const Pose& T_world_b) {
  const std::vector<Bounded> of_a = in_world(a, T_world_a), of_b = in_world(b, T_world_b);
  double least = std::numeric_limits<double>::infinity();
  for (const Bounded& one : of_a) {
    for (const Bounded& other : of_b) {
      if (one.box.exteriorDistance(other.box) >= least) continue;  // no nearer than another pair
      least = std::min(least, triangle_distance(one.triangle, other.triangle));
    }
  }
  return least;
}

bool surrounds(const TriangleMesh& mesh, const Pose& T_world_mesh, const Eigen::Vector3d& point) {
  ReferenceScene scene;
  scene.add(mesh, T_world_mesh, 0);
  double sum = 0;
  for (const WorldTriangle& triangle : scene.triangles()) {
    const Vector3d a = triangle.corners[0] - point, b = triangle.corners[1] - point,
                   c = triangle.corners[2] - point;
    sum += 2 * std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                                 b.dot(c) * a.norm() + c.dot(a) * b.norm());
  }
  return sum > 2 * std::numbers::pi;
}

}  // namespace vantage::test
