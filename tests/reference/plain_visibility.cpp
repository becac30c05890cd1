#include "reference/plain_visibility.hpp"

#include <cmath>

namespace vantage::test {

PlainSight plain_sight(const Lens& lens, const Pose& T_world_cam, const Pose& T_world_marker,
                       double size_m, double border_px, const ReferenceScene& scene) {
  const Intrinsics& k = lens.intrinsics();
  const Eigen::Vector3d eye = T_world_cam.translation();
  const Eigen::Vector3d eye_in_marker = T_world_marker.inverse() * eye;
  PlainSight sight;
  sight.side_px = size_m * std::sqrt(k.fx * k.fy) / eye_in_marker.norm();
  sight.angle_rad = std::atan2(eye_in_marker.head<2>().norm(), eye_in_marker.z());
  sight.visible = eye_in_marker.z() > 0;
  sight.close_call = std::abs(eye_in_marker.z()) < 1e-6;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      const Eigen::Vector3d p_cam =
          T_world_cam.inverse() * (T_world_marker * Eigen::Vector3d(x * size_m, y * size_m, 0));
      if (p_cam.z() < 1e-3) {
        sight.visible = false;
        continue;
      }
      const Eigen::Vector2d pixel = lens.project(p_cam);
      const double inside_px =
          std::min({pixel.x(), pixel.y(), k.width - 1 - pixel.x(), k.height - 1 - pixel.y()}) -
          border_px;
      if (inside_px <= 0) sight.visible = false;
      if (std::abs(inside_px) < 1e-6) sight.close_call = true;
    }
  }
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const double x = size_m * (-0.6 + 0.4 * column), y = size_m * (-0.6 + 0.4 * row);
      const Eigen::Vector3d point = T_world_marker * Eigen::Vector3d(x, y, 0.002);
      const Verdict blocked = scene.occluded(point.cast<float>(), eye.cast<float>());
      if (blocked.hit) sight.visible = false;
      if (blocked.close_call) sight.close_call = true;
    }
  }
  return sight;
}

}  // namespace vantage::test
