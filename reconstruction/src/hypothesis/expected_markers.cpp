#include "hypothesis/expected_markers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/reconstruction/detector_recall.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kSurePx = 30;       // the side of a marker that is hardly ever missed
constexpr double kSureFacing = 0.5;  // and the cosine between its normal and the line of sight
constexpr double kBorderPx = 10;     // white around it has to be in the image too
constexpr double kAboveM = 0.002;    // rays start in front of the marker, not in it
constexpr double kReach = 0.6;       // of its side, from its middle: white around it, too
constexpr int kRaysAlongSide = 4;    // one packet

}  // namespace

ExpectedMarkers::ExpectedMarkers(const CameraView& view, const Scene& scene)
    : view_(view), lens_(view.lens), scene_(scene), T_cam_world_(view.T_world_cam->inverse()) {}

ExpectedMarkers::Look ExpectedMarkers::look_at(const Marker& marker,
                                               const Pose& T_world_marker) const {
  const Eigen::Vector3d sight = view_.T_world_cam->translation() - T_world_marker.translation();
  const Intrinsics& k = view_.lens.intrinsics();
  return {marker.size_m * std::sqrt(k.fx * k.fy) / sight.norm(),
          T_world_marker.rotation().col(2).dot(sight.normalized())};
}

double ExpectedMarkers::found_probability(const Marker& marker, const Pose& T_world_object) const {
  const Pose T_world_marker = T_world_object * marker.T_object_marker;
  const Look look = look_at(marker, T_world_marker);
  if (!(look.cosine > 0)) return 0;
  const double recall = detector_recall(look.side_px, std::acos(std::min(1.0, look.cosine)));
  const bool in_sight =
      recall > 0 && is_inside(marker, T_world_object) && !is_hidden(marker, T_world_marker);
  return in_sight ? (1 - kMarkerMissed) * recall : 0;
}

bool ExpectedMarkers::sees(const Marker& marker, const Pose& T_world_object) const {
  const Pose T_world_marker = T_world_object * marker.T_object_marker;
  const Look look = look_at(marker, T_world_marker);
  return look.cosine > kSureFacing && look.side_px * look.cosine >= kSurePx &&
         is_inside(marker, T_world_object) && !is_hidden(marker, T_world_marker);
}

bool ExpectedMarkers::is_inside(const Marker& marker, const Pose& T_world_object) const {
  const Intrinsics& k = view_.lens.intrinsics();
  const auto corners = marker.corners();
  return std::ranges::all_of(corners, [&](const Eigen::Vector3d& corner) {
    const Eigen::Vector3d p = T_cam_world_ * (T_world_object * corner);
    if (!is_before(p)) return false;
    const Eigen::Vector2d pixel = lens_.project(p);
    return pixel.minCoeff() > kBorderPx && pixel.x() < k.width - 1 - kBorderPx &&
           pixel.y() < k.height - 1 - kBorderPx;
  });
}

bool ExpectedMarkers::is_hidden(const Marker& marker, const Pose& T_world_marker) const {
  constexpr int kRays = kRaysAlongSide * kRaysAlongSide;
  static_assert(kRays == kPacketWidth);
  alignas(64) std::array<float, kRays> x, y, z;
  for (int i = 0; i < kRays; ++i) {
    const auto along = [&](int n) {
      return kReach * marker.size_m * (2.0 * n / (kRaysAlongSide - 1) - 1);
    };
    const Eigen::Vector3f p = (T_world_marker * Eigen::Vector3d(along(i % kRaysAlongSide),
                                                                along(i / kRaysAlongSide), kAboveM))
                                  .cast<float>();
    x[std::size_t(i)] = p.x(), y[std::size_t(i)] = p.y(), z[std::size_t(i)] = p.z();
  }
  const std::uint32_t packet = 0;
  const std::uint16_t wanted = 0xFFFF;
  std::uint16_t hidden = 0;
  scene_.occluded(PointsView{x.data(), y.data(), z.data(), kRays},
                  view_.T_world_cam->translation().cast<float>(), {&packet, 1}, {&wanted, 1},
                  {&hidden, 1});
  return hidden != 0;
}

}  // namespace vantage::reconstruction::detail
