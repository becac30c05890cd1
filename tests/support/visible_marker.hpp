#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/reconstruction/marker.hpp"

namespace vantage::test {

/// Whether a grid of points on the marker and half a cell around it is in the image and seen:
/// without white around it, a marker is none.
inline bool in_full_view(const Marker& marker, const Pose& T_world_object, const Scene& scene,
                         const PinholeCamera& camera) {
  constexpr int kGrid = 14;
  const int cells = marker_cells(marker.dictionary, marker.id, "marker").side;
  const double seen_m = marker.size_m * (cells + 1) / cells;
  constexpr double kBorder = 5;  // pixels; OpenCV leaves out what is nearer than 3
  for (int i = 0; i <= kGrid; ++i) {
    for (int j = 0; j <= kGrid; ++j) {
      const double x = seen_m * (double(i) / kGrid - 0.5);
      const double y = seen_m * (double(j) / kGrid - 0.5);
      const Eigen::Vector3d p =
          T_world_object * (marker.T_object_marker * Eigen::Vector3d(x, y, 1e-4));
      const auto at = camera.project(p);
      if (!at || at->u < kBorder || at->u > camera.intrinsics().width - kBorder ||
          at->v < kBorder || at->v > camera.intrinsics().height - kBorder) {
        return false;
      }
      if (scene.occluded(p.cast<float>(), camera.centre().cast<float>())) return false;
    }
  }
  return true;
}

/// Where the marker's corners are on the image, if it has to be found there: every side longer than
/// 25 px, less than 60 degrees off axis and in full view.
inline std::optional<std::array<Eigen::Vector2d, 4>> visible_corners(const Marker& marker,
                                                                     const Pose& T_world_object,
                                                                     const Scene& scene,
                                                                     const PinholeCamera& camera) {
  const Pose T_world_marker = T_world_object * marker.T_object_marker;
  const Eigen::Vector3d to_camera = camera.centre() - T_world_marker.translation();
  const double cosine = to_camera.normalized().dot(T_world_marker.rotation().col(2));
  if (cosine < std::cos(std::numbers::pi / 3)) return std::nullopt;
  if (!in_full_view(marker, T_world_object, scene, camera)) return std::nullopt;
  std::array<Eigen::Vector2d, 4> corners;
  for (std::size_t c = 0; c < 4; ++c) {
    const auto at = camera.project(T_world_object * marker.corners()[c]);
    corners[c] = {at->u, at->v};
  }
  for (std::size_t c = 0; c < 4; ++c) {
    if ((corners[c] - corners[(c + 1) % 4]).norm() <= 25) return std::nullopt;
  }
  return corners;
}

}  // namespace vantage::test
