#include "reasoning/presence.hpp"

#include <algorithm>
#include <cmath>

namespace vantage::reconstruction::detail {
namespace {

constexpr double kAbove_m = 0.003;    ///< rays start in front of a surface, not in it
constexpr double kPointsFound = 0.5;  ///< points that nothing hides, by detectors that nobody knows

}  // namespace

Presence::Presence(std::span<const CameraView> views, std::span<const DepthCamera> depth,
                   const Scene& scene)
    : views_(views), depth_(depth), scene_(scene), depth_beside_(depth_beside(views, depth)) {
  for (const CameraView& view : views) {
    markers_.push_back(view.T_world_cam ? std::make_unique<ExpectedMarkers>(view, scene) : nullptr);
  }
}

bool Presence::is_measured_before(std::size_t view, const Eigen::Vector3d& p_world) const {
  return std::ranges::any_of(depth_beside_[view], [&](const DepthCamera* depth) {
    const auto reading = depth_reading(*depth, p_world);
    return reading && reading->is_before();
  });
}

bool Presence::is_in_sight(std::size_t view, const std::vector<Eigen::Vector3d>& points,
                           const Pose& T_world_object) const {
  const Pose T_cam_world = views_[view].T_world_cam->inverse();
  const Eigen::Vector3d& eye = views_[view].T_world_cam->translation();
  const Intrinsics& k = views_[view].lens.intrinsics();
  const WideLens lens(views_[view].lens);
  return std::ranges::all_of(points, [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d p = T_world_object * point, p_cam = T_cam_world * p;
    if (!is_before(p_cam)) return false;
    const Eigen::Vector2d pixel = lens.project(p_cam);
    if (!(pixel.minCoeff() > 0 && pixel.x() < k.width - 1 && pixel.y() < k.height - 1)) {
      return false;
    }
    const Eigen::Vector3d start = p + kAbove_m * (eye - p).normalized();
    return !scene_.occluded(start.cast<float>(), eye.cast<float>());
  });
}

bool Presence::is_behind_something(std::size_t view, const std::vector<Eigen::Vector3d>& points,
                                   const Pose& T_world_object) const {
  return std::ranges::any_of(points, [&](const Eigen::Vector3d& point) {
    return is_measured_before(view, T_world_object * point);
  });
}

double Presence::found_probability(std::size_t view, const ObjectFeature& feature,
                                   const Pose& T_world_object) const {
  if (!markers_[view]) return 0;
  const std::vector<Eigen::Vector3d> points = feature.points();
  if (points.empty()) return 0;  // a frame or a label may be anywhere in the object
  const auto* marker = std::get_if<Marker>(&feature.geometry);
  double found = kPointsFound;
  if (marker != nullptr) {
    found = markers_[view]->found_probability(*marker, T_world_object);
  } else if (!is_in_sight(view, points, T_world_object)) {
    found = 0;
  }
  return found > 0 && !is_behind_something(view, points, T_world_object) ? found : 0;
}

bool Presence::is_sure_to_see(std::size_t view, const ObjectFeature& feature,
                              const Pose& T_world_object) const {
  if (!markers_[view]) return false;
  const std::vector<Eigen::Vector3d> points = feature.points();
  if (points.empty()) return false;
  const auto* marker = std::get_if<Marker>(&feature.geometry);
  const bool in_sight = marker != nullptr ? markers_[view]->sees(*marker, T_world_object)
                                          : is_in_sight(view, points, T_world_object);
  return in_sight && !is_behind_something(view, points, T_world_object);
}

std::vector<double> Presence::missed_probability(const ObjectType& type,
                                                 const Pose& T_world_object) const {
  std::vector<double> missed(views_.size(), 1);
  for (std::size_t v = 0; v < views_.size(); ++v) {
    for (const ObjectFeature& feature : type.features) {
      if (is_sure_to_see(v, feature, T_world_object)) missed[v] *= kMarkerMissed;
    }
  }
  return missed;
}

DepthAtObject Presence::depth_at(const std::vector<SurfacePoint>& surface,
                                 const Pose& T_world_object) const {
  DepthAtObject sum;
  for (const DepthCamera& camera : depth_) {
    if (!camera.depth) continue;
    const DepthAtObject one = detail::depth_at(camera, surface, T_world_object);
    sum.through += one.through, sum.at += one.at, sum.hidden += one.hidden;
  }
  return sum;
}

}  // namespace vantage::reconstruction::detail
