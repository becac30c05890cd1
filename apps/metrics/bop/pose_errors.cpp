#include "metrics/bop/pose_errors.hpp"

#include <algorithm>

#include "metrics/bop/nearest_vertex.hpp"

namespace vantage {
namespace {

/// The largest distance, or anything above `bound` if it is larger than that.
template <class Points>
double largest_distance(const Points& a, const Points& b, double bound) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size() && largest <= bound; ++i) {
    largest = std::max(largest, (a[i] - b[i]).norm());
  }
  return largest;
}

std::vector<Eigen::Vector3d> transformed(const ErrorModel& model, const Pose& pose) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(model.vertices.size());
  for (const Eigen::Vector3d& vertex : model.vertices) points.push_back(pose * vertex);
  return points;
}

/// Empty if a vertex is not before the camera.
std::vector<Eigen::Vector2d> projected(const ErrorModel& model, const Pose& T_cam_object,
                                       const Intrinsics& k) {
  std::vector<Eigen::Vector2d> pixels;
  pixels.reserve(model.vertices.size());
  for (const Eigen::Vector3d& vertex : model.vertices) {
    const Eigen::Vector3d p = T_cam_object * vertex;
    if (!(p.z() > 0)) return {};
    pixels.emplace_back(k.fx * p.x() / p.z() + k.cx, k.fy * p.y() / p.z() + k.cy);
  }
  return pixels;
}

}  // namespace

double translation_error_m(const Pose& estimate, const Pose& truth) {
  return (estimate.translation() - truth.translation()).norm();
}

double rotation_error_rad(const Pose& estimate, const Pose& truth) {
  return estimate.quaternion().angularDistance(truth.quaternion());
}

double add_m(const ErrorModel& model, const Pose& estimate, const Pose& truth) {
  double sum = 0;
  for (const Eigen::Vector3d& vertex : model.vertices) {
    sum += (estimate * vertex - truth * vertex).norm();
  }
  return sum / double(model.vertices.size());
}

double add_s_m(const ErrorModel& model, const Pose& estimate, const Pose& truth) {
  const NearestVertex estimated(transformed(model, estimate));
  double sum = 0;
  for (const Eigen::Vector3d& vertex : transformed(model, truth)) {
    sum += estimated.distance_m(vertex);
  }
  return sum / double(model.vertices.size());
}

SymmetricTruth nearest_symmetric(const ErrorModel& model, const Pose& estimate, const Pose& truth) {
  const std::vector<Eigen::Vector3d> estimated = transformed(model, estimate);
  SymmetricTruth nearest{truth, kInfinite};
  for (const Pose& motion : model.symmetries) {
    const Pose turned = truth * motion;
    const double distance = largest_distance(estimated, transformed(model, turned), nearest.mssd_m);
    if (distance < nearest.mssd_m) nearest = {turned, distance};
  }
  return nearest;
}

double mssd_m(const ErrorModel& model, const Pose& estimate, const Pose& truth) {
  return nearest_symmetric(model, estimate, truth).mssd_m;
}

double mspd_px(const ErrorModel& model, const Pose& estimate, const Pose& truth,
               const Intrinsics& camera) {
  const std::vector<Eigen::Vector2d> estimated = projected(model, estimate, camera);
  double least = kInfinite;
  if (estimated.empty()) return least;
  for (const Pose& motion : model.symmetries) {
    const std::vector<Eigen::Vector2d> turned = projected(model, truth * motion, camera);
    if (!turned.empty()) least = std::min(least, largest_distance(estimated, turned, least));
  }
  return least;
}

}  // namespace vantage
