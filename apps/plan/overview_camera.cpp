#include "plan/overview_camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "plan/plan_shapes.hpp"

namespace vantage {
namespace {

double azimuth_of(const Eigen::Vector3d& v) {
  return std::atan2(v.y(), v.x());
}

/// From which azimuth to look: beside the suggested camera, on the side where the mean of the given
/// ones is, so that both of them are seen and neither stands in the way.
double overview_azimuth(const Plan& plan, const WorldModel& world) {
  const Eigen::Vector3d centre = plan.request.work_area.centre();
  Eigen::Vector3d given = Eigen::Vector3d::Zero();
  for (const Observer& observer : world.cameras) given += observer.camera.centre() - centre;
  const double given_azimuth = azimuth_of(given);
  const std::vector<PinholeCamera> cameras = suggested_cameras(plan);
  if (cameras.empty()) return given_azimuth + std::numbers::pi / 3;
  const Eigen::Vector3d suggested = cameras.front().centre() - centre;
  const bool from_above = suggested.head<2>().norm() < 0.3 * suggested.norm();
  if (from_above) return given_azimuth + std::numbers::pi / 3;
  const double turn = std::remainder(given_azimuth - azimuth_of(suggested), 2 * std::numbers::pi);
  return azimuth_of(suggested) + (turn < 0 ? -1 : 1) * std::numbers::pi / 3.6;
}

}  // namespace

PinholeCamera overview_camera(const Plan& plan, const WorldModel& world, int width) {
  const int height = std::max(1, width * 5 / 8);
  std::vector<Eigen::Vector3d> points;
  for (const ColoredMesh& part : camera_meshes(plan, world)) {
    for (const Eigen::Vector3f& p : part.mesh.vertices()) points.push_back(p.cast<double>());
  }
  Eigen::Vector3d low = points.front(), high = points.front();
  for (const Eigen::Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Eigen::Vector3d centre = 0.5 * (low + high);
  const double azimuth = overview_azimuth(plan, world), elevation = 0.48;
  const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  const Pose pose = Pose::looking_at(centre + 1.5 * (high - low).norm() * direction, centre);

  const PinholeCamera unit({width, height, 1, 1, 0, 0}, pose);
  Eigen::Array2d least(1e9, 1e9), most(-1e9, -1e9);
  for (const Eigen::Vector3d& p : points) {
    const std::optional<ImagePoint> q = unit.project(p);
    least = least.min(Eigen::Array2d(q->u, q->v)), most = most.max(Eigen::Array2d(q->u, q->v));
  }
  const Eigen::Array2d size(width, height);
  const double focal = (0.93 * size / (most - least)).minCoeff();
  const Eigen::Array2d principal = 0.5 * size - focal * 0.5 * (least + most);
  return PinholeCamera({width, height, focal, focal, principal.x(), principal.y()}, pose);
}

}  // namespace vantage
