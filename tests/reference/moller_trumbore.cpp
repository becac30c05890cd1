#include "reference/moller_trumbore.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage::test {

Crossing WorldTriangle::cross(const Eigen::Vector3d& origin,
                              const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  const Eigen::Vector3d normal = ab.cross(ac);
  const double determinant = -direction.dot(normal);

  // The volume of (ray, edge) tells on which side of the edge the line passes; over the length of
  // the cross product it is the distance of the two lines.
  double margin = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d a = corners[i], edge = corners[(i + 1) % 3] - a;
    const Eigen::Vector3d across = edge.cross(direction);
    const double length = across.norm();
    const double signed_distance = length > 0 ? (origin - a).dot(across) / length : 0;
    margin = std::min(margin, determinant > 0 ? signed_distance : -signed_distance);
  }
  return {(origin - corners[0]).dot(normal) / determinant, margin,
          std::abs(determinant) / (normal.norm() * direction.norm()), normal.normalized()};
}

double WorldTriangle::distance_to_plane(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  return std::abs((point - corners[0]).dot(normal.normalized()));
}

void ReferenceScene::add(const TriangleMesh& mesh, const Pose& T_world_mesh, ObjectId object) {
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
    WorldTriangle triangle{{}, object, std::uint32_t(i)};
    for (int c = 0; c < 3; ++c) {
      triangle.corners[c] = T_world_mesh * Eigen::Vector3d(mesh.corner(i, c).cast<double>());
    }
    triangles_.push_back(triangle);
  }
}

Verdict ReferenceScene::closest_hit(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                                    double t_near, double t_far) const {
  const Eigen::Vector3d o = origin.cast<double>(), d = direction.cast<double>();
  double closest = std::numeric_limits<double>::infinity();     // certainly hit
  double close_call = std::numeric_limits<double>::infinity();  // perhaps hit
  for (const WorldTriangle& triangle : triangles_) {
    const Crossing c = triangle.cross(o, d);
    if (!(c.margin_m >= -kCloseCall)) continue;
    const auto near_plane = [&](double t) {
      return std::isfinite(t) && triangle.distance_to_plane(o + t * d) <= kCloseCall;
    };
    if (c.margin_m <= kCloseCall || near_plane(t_near) || near_plane(t_far)) {
      const double slack = kCloseCall / (c.cosine * d.norm());
      if (c.t + slack >= t_near && c.t - slack <= t_far)
        close_call = std::min(close_call, c.t - slack);
    } else if (c.t >= t_near && c.t <= t_far) {
      closest = std::min(closest, c.t);
    }
  }
  return {std::isfinite(closest), close_call <= closest && std::isfinite(close_call), closest};
}

Verdict ReferenceScene::occluded(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const {
  Verdict verdict = closest_hit(from, to - from, 0, 1);
  if (verdict.hit) verdict.close_call = false;  // another hit before would not change the answer
  return verdict;
}

const WorldTriangle* ReferenceScene::find(ObjectId object, std::uint32_t index) const {
  const auto found =
      std::find_if(triangles_.begin(), triangles_.end(),
                   [&](const WorldTriangle& t) { return t.object == object && t.index == index; });
  return found == triangles_.end() ? nullptr : &*found;
}

}  // namespace vantage::test
