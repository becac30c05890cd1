#include "reasoning/evidence_depth.hpp"

#include <algorithm>
#include <cmath>

namespace vantage::reconstruction::detail {
namespace {

constexpr std::size_t kSurfacePoints = 48;
constexpr double kBeside_m = 0.06;  ///< a depth imager this near to a camera sees what it sees
constexpr double kMinFacing = 0.3;  ///< cosine; depth is not measured at grazing angles

/// Shares of the points that are seen through if the object is there (its pose and the depth are
/// not perfect), and if it is not (something else often is).
constexpr double kThroughThere = 0.08, kThroughGone = 0.55;
constexpr double kIndependentPoints = 5;  ///< of one image
constexpr int kFewPoints = 4;

/// A feature's points lie where depth has a surface, if the object is there and if it is not.
constexpr double kFeatureOnSurface = 1.2, kFeatureOffSurface = -4;

/// Depths that differ by less may be the same surface.
double tolerance_m(double depth_m) {
  return std::max(0.01, 0.015 * depth_m);
}

}  // namespace

bool DepthReading::is_before(double slack_m) const {
  return measured_m < expected_m - tolerance_m(expected_m) - slack_m;
}

bool DepthReading::is_behind(double slack_m) const {
  return measured_m > expected_m + tolerance_m(expected_m) + slack_m;
}

std::optional<DepthReading> depth_reading(const DepthCamera& camera,
                                          const Eigen::Vector3d& p_world) {
  const std::optional<ImagePoint> at = camera.camera.project(p_world);
  if (!at) return std::nullopt;
  const double u = std::round(at->u), v = std::round(at->v);
  const DepthImage& image = *camera.depth;
  if (!(u >= 0 && v >= 0 && u < image.width() && v < image.height())) return std::nullopt;
  const DepthRange& range = camera.camera.range();
  if (at->depth < range.near_m || at->depth > range.far_m) return std::nullopt;
  const double measured = double(image.at(int(u), int(v)));
  if (!(measured >= range.near_m)) return std::nullopt;
  return DepthReading{measured, at->depth};
}

std::vector<std::vector<const DepthCamera*>> depth_beside(std::span<const CameraView> views,
                                                          std::span<const DepthCamera> depth) {
  std::vector<std::vector<const DepthCamera*>> beside(views.size());
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (!views[v].T_world_cam) continue;
    for (const DepthCamera& camera : depth) {
      if (!camera.depth) continue;
      const double apart = (camera.camera.centre() - views[v].T_world_cam->translation()).norm();
      if (apart < kBeside_m) beside[v].push_back(&camera);
    }
  }
  return beside;
}

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

DepthAtObject depth_at(const DepthCamera& camera, std::span<const SurfacePoint> surface,
                       const Pose& T_world_object, double slack_m) {
  DepthAtObject result;
  const Eigen::Vector3d& eye = camera.camera.centre();
  for (const SurfacePoint& point : surface) {
    const Eigen::Vector3d p = T_world_object * point.p_object;
    const Eigen::Vector3d normal = T_world_object.rotation() * point.normal;
    if (normal.dot((eye - p).normalized()) < kMinFacing) continue;
    const auto reading = depth_reading(camera, p);
    if (!reading) continue;
    if (reading->is_before(slack_m)) {
      ++result.hidden;
    } else {
      ++(reading->is_behind(slack_m) ? result.through : result.at);
    }
  }
  return result;
}

double log_ratio_of(const DepthAtObject& shown) {
  const int points = shown.through + shown.at;
  if (points < kFewPoints) return 0;
  const double sum = shown.through * std::log(kThroughThere / kThroughGone) +
                     shown.at * std::log((1 - kThroughThere) / (1 - kThroughGone));
  return sum * std::min(1.0, kIndependentPoints / points);
}

double log_ratio_at_features(const ReconstructedObject& object,
                             std::span<const std::vector<const DepthCamera*>> beside,
                             double slack_m) {
  double sum = 0;
  for (const Support& support : object.support) {
    const auto points = object.type->features[support.feature].points();
    for (const DepthCamera* camera : beside[support.id.view]) {
      std::size_t on = 0, off = 0;
      for (const Eigen::Vector3d& point : points) {
        const auto reading = depth_reading(*camera, object.T_world_object * point);
        if (!reading) continue;
        ++(reading->is_before(slack_m) || reading->is_behind(slack_m) ? off : on);
      }
      if (2 * (on + off) <= points.size()) continue;  // too few readings
      if (off == 0) sum += kFeatureOnSurface;
      if (on == 0) sum += kFeatureOffSurface;
    }
  }
  return sum;
}

}  // namespace vantage::reconstruction::detail
