#include "metrics/reconstruction/seen_objects.hpp"

#include <algorithm>

namespace vantage {
namespace {

struct Tolerance {
  double px, m;
};

bool is_at(const SeenPoints& seen, const ObjectFeature& feature, const Lens& lens,
           const Pose& T_cam_object, const Tolerance& tolerance) {
  const std::vector<Eigen::Vector3d> points = feature.points();
  if (points.empty() || points.size() != seen.pixels.size()) return false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p_cam = T_cam_object * points[i];
    if (!(p_cam.z() > 0)) return false;
    if (!((lens.project(p_cam) - seen.pixels[i]).norm() <= tolerance.px)) return false;
  }
  return true;
}

bool is_at(const SeenPose& seen, const ObjectFeature& feature, const Lens&,
           const Pose& T_cam_object, const Tolerance& tolerance) {
  const auto* pose = std::get_if<FeaturePose>(&feature.geometry);
  if (!pose) return false;
  const Pose expected = T_cam_object * pose->T_object_feature;
  return (expected.translation() - seen.T_cam_feature.translation()).norm() <= tolerance.m;
}

bool is_at(const SeenLabel& seen, const ObjectFeature& feature, const Lens&,
           const Pose& T_cam_object, const Tolerance& tolerance) {
  const auto* label = std::get_if<FeatureLabel>(&feature.geometry);
  if (!label) return false;
  return std::ranges::any_of(label->points_m, [&](const Eigen::Vector3d& point) {
    return (T_cam_object * point - seen.p_cam_m).norm() <= tolerance.m + label->radius_m;
  });
}

bool sees(const CameraView& view, const TrueObject& object, const Tolerance& tolerance) {
  const Pose T_cam_object = view.T_world_cam->inverse() * object.T_world_object;
  for (const Observation& observation : view.observations) {
    for (const ObjectFeature& feature : object.type->features) {
      if (feature.key != observation.key) continue;
      const bool there = std::visit(
          [&](const auto& seen) {
            return is_at(seen, feature, view.lens, T_cam_object, tolerance);
          },
          observation.data);
      if (there) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<std::vector<bool>> seen_objects(std::span<const CameraView> views,
                                            std::span<const TrueObject> truth, double tolerance_px,
                                            double tolerance_m) {
  std::vector<std::vector<bool>> seen;
  for (const CameraView& view : views) {
    seen.emplace_back(truth.size(), false);
    for (std::size_t i = 0; i < truth.size() && view.T_world_cam; ++i) {
      seen.back()[i] = sees(view, truth[i], {tolerance_px, tolerance_m});
    }
  }
  return seen;
}

std::vector<bool> seen_by(std::span<const std::vector<bool>> seen,
                          std::span<const std::size_t> views) {
  std::vector<bool> any(seen.empty() ? 0 : seen.front().size(), false);
  for (const std::size_t view : views) {
    for (std::size_t i = 0; i < any.size(); ++i) any[i] = any[i] || seen[view][i];
  }
  return any;
}

}  // namespace vantage
