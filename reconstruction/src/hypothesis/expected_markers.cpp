#include "hypothesis/expected_markers.hpp"

#include <algorithm>
#include <array>

namespace vantage::reconstruction::detail {
namespace {

constexpr double kMinSidePx = 30;   // smaller markers may well not be found
constexpr double kMinFacing = 0.5;  // cosine of the angle between the normal and the line of sight
constexpr double kBorderPx = 10;    // white around it has to be in the image too
constexpr double kAboveM = 0.002;   // rays start in front of the marker, not in it

}  // namespace

ExpectedMarkers::ExpectedMarkers(const CameraView& view, const Scene& scene)
    : view_(view), lens_(view.lens), scene_(scene), T_cam_world_(view.T_world_cam->inverse()) {}

bool ExpectedMarkers::sees(const Marker& marker, const Pose& T_world_object) const {
  const Pose T_world_marker = T_world_object * marker.T_object_marker;
  const Eigen::Vector3d& eye = view_.T_world_cam->translation();
  const Eigen::Vector3d normal = T_world_marker.rotation().col(2);
  const Eigen::Vector3d sight = (eye - T_world_marker.translation()).normalized();
  if (!(normal.dot(sight) > kMinFacing)) return false;
  const auto corners = marker.corners();
  std::array<Eigen::Vector2d, 4> pixels;
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = T_cam_world_ * (T_world_object * corners[i]);
    if (!is_before(p)) return false;
    pixels[i] = lens_.project(p);
    if (!is_inside(pixels[i])) return false;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    if ((pixels[(i + 1) % 4] - pixels[i]).norm() < kMinSidePx) return false;
  }
  return std::none_of(corners.begin(), corners.end(), [&](const Eigen::Vector3d& corner) {
    const Eigen::Vector3d start = T_world_object * corner + kAboveM * normal;
    return scene_.occluded(start.cast<float>(), eye.cast<float>());
  });
}

bool ExpectedMarkers::is_inside(const Eigen::Vector2d& pixel) const {
  const Intrinsics& k = view_.lens.intrinsics();
  return pixel.x() > kBorderPx && pixel.y() > kBorderPx && pixel.x() < k.width - 1 - kBorderPx &&
         pixel.y() < k.height - 1 - kBorderPx;
}

}  // namespace vantage::reconstruction::detail
