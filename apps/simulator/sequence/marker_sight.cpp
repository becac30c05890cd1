#include "simulator/sequence/marker_sight.hpp"

#include <cmath>
#include <numbers>

#include "vantage/reconstruction/detector_recall.hpp"

namespace vantage {
namespace {

constexpr double kBorderPx = 2;
constexpr int kRaysAlongSide = 6;
constexpr double kAboveSurfaceM = 2e-4;  // rays end above the print, not in it
constexpr double kMarginCells = 0.5, kCells = 6;

bool in_image(const Eigen::Vector2d& pixel, const Intrinsics& k) {
  return pixel.x() >= kBorderPx && pixel.y() >= kBorderPx && pixel.x() <= k.width - 1 - kBorderPx &&
         pixel.y() <= k.height - 1 - kBorderPx;
}

bool hidden(const Pose& T_world_marker, double size_m, const Eigen::Vector3d& eye,
            const Scene& scene) {
  const double half = size_m * (0.5 + kMarginCells / kCells);
  for (int i = 0; i < kRaysAlongSide; ++i) {
    for (int j = 0; j < kRaysAlongSide; ++j) {
      const auto along = [&](int n) { return half * (2.0 * n / (kRaysAlongSide - 1) - 1); };
      const Eigen::Vector3d point =
          T_world_marker * Eigen::Vector3d(along(i), along(j), kAboveSurfaceM);
      if (scene.occluded(point.cast<float>(), eye.cast<float>())) return true;
    }
  }
  return false;
}

}  // namespace

std::optional<MarkerSight> see_marker(const Marker& marker, const Pose& T_world_object,
                                      const SequenceCamera& camera, const Scene& scene) {
  const Pose T_world_marker = T_world_object * marker.T_object_marker;
  const Eigen::Vector3d to_eye = camera.camera.centre() - T_world_marker.translation();
  const double cosine = T_world_marker.rotation().col(2).dot(to_eye.normalized());
  if (cosine <= 0) return {};
  const Pose T_cam_object = camera.camera.T_world_cam().inverse() * T_world_object;
  MarkerSight sight;
  const auto corners = marker.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d p_cam = T_cam_object * corners[i];
    if (p_cam.z() <= 0 || p_cam.head<2>().norm() / p_cam.z() > camera.lens.reach()) return {};
    sight.corners_px[i] = camera.lens.project(p_cam);
    if (!in_image(sight.corners_px[i], camera.lens.intrinsics())) return {};
  }
  const Intrinsics& k = camera.lens.intrinsics();
  const double side_px = marker.size_m * std::sqrt(k.fx * k.fy) / to_eye.norm();
  sight.recall = detector_recall(side_px, std::acos(std::min(1.0, cosine)));
  if (sight.recall <= 0 || hidden(T_world_marker, marker.size_m, camera.camera.centre(), scene)) {
    return {};
  }
  return sight;
}

}  // namespace vantage
