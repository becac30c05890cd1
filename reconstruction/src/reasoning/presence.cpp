#include "reasoning/presence.hpp"

#include <algorithm>
#include <cmath>

namespace vantage::reconstruction::detail {
namespace {

constexpr std::size_t kSurfacePoints = 48;
constexpr double kBeside_m = 0.06;  ///< a depth imager this near to a camera sees what it sees
constexpr double kMinFacing = 0.3;  ///< cosine; depth is not measured at grazing angles
constexpr double kAbove_m = 0.003;  ///< rays start in front of a surface, not in it

/// Depths that differ by less may be the same surface.
double tolerance_m(double depth_m) {
  return std::max(0.01, 0.015 * depth_m);
}

/// Depth at a point's pixel; NaN where there is none.
struct Reading {
  double measured_m = std::nan(""), expected_m = 0;
};

Reading reading_at(const DepthCamera& depth, const Eigen::Vector3d& p_world) {
  const std::optional<ImagePoint> at = depth.camera.project(p_world);
  if (!at) return {};
  const double u = std::round(at->u), v = std::round(at->v);
  if (!(u >= 0 && v >= 0 && u < depth.depth->width() && v < depth.depth->height())) return {};
  const double measured = double(depth.depth->at(int(u), int(v)));
  const DepthRange& range = depth.camera.range();
  if (at->depth < range.near_m || at->depth > range.far_m) return {};
  return {measured < range.near_m ? std::nan("") : measured, at->depth};
}

Eigen::Vector3d towards(const Eigen::Vector3d& p, const Eigen::Vector3d& eye) {
  return p + kAbove_m * (eye - p).normalized();
}

}  // namespace

std::vector<SurfacePoint> surface_points(const TriangleMesh& mesh) {
  std::vector<double> until;
  double area = 0;
  const auto corner = [&](std::size_t t, int i) {
    return Eigen::Vector3d(mesh.corner(t, i).cast<double>());
  };
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    area += 0.5 * (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).norm();
    until.push_back(area);
  }
  std::vector<SurfacePoint> points;
  if (!(area > 0)) return points;
  for (std::size_t i = 0; i < kSurfacePoints; ++i) {
    // Steps of equal area, and within a triangle the R2 sequence folded into it (Roberts 2018).
    const double at = (double(i) + 0.5) / kSurfacePoints * area;
    const auto t = std::size_t(std::ranges::upper_bound(until, at) - until.begin());
    double a = std::fmod(0.7548776662466927 * double(i + 1), 1.0);
    double b = std::fmod(0.5698402909980532 * double(i + 1), 1.0);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    const Eigen::Vector3d p = corner(t, 0), x = corner(t, 1) - p, y = corner(t, 2) - p;
    points.push_back({p + a * x + b * y, x.cross(y).normalized()});
  }
  return points;
}

Presence::Presence(std::span<const CameraView> views, std::span<const DepthCamera> depth,
                   const Scene& scene)
    : views_(views), depth_(depth), scene_(scene), depth_beside_(views.size()) {
  for (std::size_t v = 0; v < views.size(); ++v) {
    markers_.push_back(views[v].T_world_cam ? std::make_unique<ExpectedMarkers>(views[v], scene)
                                            : nullptr);
    if (!views[v].T_world_cam) continue;
    for (const DepthCamera& camera : depth) {
      if (!camera.depth) continue;
      const double apart = (camera.camera.centre() - views[v].T_world_cam->translation()).norm();
      if (apart < kBeside_m) depth_beside_[v].push_back(&camera);
    }
  }
}

bool Presence::is_measured_before(std::size_t view, const Eigen::Vector3d& p_world) const {
  return std::ranges::any_of(depth_beside_[view], [&](const DepthCamera* depth) {
    const Reading reading = reading_at(*depth, p_world);
    return reading.measured_m < reading.expected_m - tolerance_m(reading.expected_m);
  });
}

bool Presence::sees(std::size_t view, const ObjectFeature& feature,
                    const Pose& T_world_object) const {
  const auto* marker = std::get_if<Marker>(&feature.geometry);
  std::vector<Eigen::Vector3d> points = feature.points();
  if (marker != nullptr) {
    if (!markers_[view]->sees(*marker, T_world_object)) return false;
  } else if (points.empty()) {
    return false;  // a frame or a label may be anywhere in the object
  }
  const Eigen::Vector3d& eye = views_[view].T_world_cam->translation();
  return std::ranges::all_of(points, [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d p = T_world_object * point;
    if (is_measured_before(view, p)) return false;
    if (marker != nullptr) return true;
    const Eigen::Vector3d p_cam = views_[view].T_world_cam->inverse() * p;
    const Intrinsics& k = views_[view].lens.intrinsics();
    if (!is_before(p_cam)) return false;
    const Eigen::Vector2d pixel = WideLens(views_[view].lens).project(p_cam);
    if (!(pixel.minCoeff() > 0 && pixel.x() < k.width - 1 && pixel.y() < k.height - 1)) {
      return false;
    }
    return !scene_.occluded(towards(p, eye).cast<float>(), eye.cast<float>());
  });
}

std::vector<int> Presence::expected_features(const ObjectType& type,
                                             const Pose& T_world_object) const {
  std::vector<int> expected(views_.size(), 0);
  for (std::size_t v = 0; v < views_.size(); ++v) {
    if (!markers_[v]) continue;
    for (const ObjectFeature& feature : type.features) {
      if (sees(v, feature, T_world_object)) ++expected[v];
    }
  }
  return expected;
}

DepthAtObject Presence::depth_at(const std::vector<SurfacePoint>& surface,
                                 const Pose& T_world_object) const {
  DepthAtObject result;
  for (const DepthCamera& depth : depth_) {
    if (!depth.depth) continue;
    const Eigen::Vector3d& eye = depth.camera.centre();
    for (const SurfacePoint& point : surface) {
      const Eigen::Vector3d p = T_world_object * point.p_object;
      const Eigen::Vector3d normal = T_world_object.rotation() * point.normal;
      if (normal.dot((eye - p).normalized()) < kMinFacing) continue;
      const Reading reading = reading_at(depth, p);
      if (std::isnan(reading.measured_m)) continue;
      const double behind = reading.measured_m - reading.expected_m;
      const double tolerance = tolerance_m(reading.expected_m);
      if (behind < -tolerance) {
        ++result.hidden;
      } else {
        ++(behind > tolerance ? result.through : result.at);
      }
    }
  }
  return result;
}

}  // namespace vantage::reconstruction::detail
