#include "track/tracked_cameras.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace vantage {
namespace {

constexpr double kMoved = 42;  ///< chi-square of six coordinates: once in ten million by noise
constexpr double kMin_m = 0.003, kMin_rad = 0.003;  ///< what a board's fit leaves unsaid

/// Whether two located poses are of one place, within what their covariances say.
bool agree(const Pose& a, const Matrix6d& covariance_a, const Pose& b,
           const Matrix6d& covariance_b) {
  Eigen::Matrix<double, 6, 1> step;
  step.head<3>() = b.translation() - a.translation();
  const Eigen::AngleAxisd turn(b.rotation() * a.rotation().transpose());
  step.tail<3>() = turn.angle() * turn.axis();
  Matrix6d sum = covariance_a + covariance_b;
  sum.diagonal().head<3>().array() += kMin_m * kMin_m;
  sum.diagonal().tail<3>().array() += kMin_rad * kMin_rad;
  return step.dot(sum.llt().solve(step)) < kMoved;
}

}  // namespace

std::vector<std::string> TrackedCameras::apply(const BopScene& scene, ObservedScene& observed) {
  std::vector<std::string> warnings;
  for (std::size_t v = 0; v < observed.views.size(); ++v) {
    CameraView& view = observed.views[v];
    const int image = scene.images[v].id;
    const auto known = cameras_.find(image);
    if (!view.T_world_cam) {
      if (known == cameras_.end()) continue;
      view.T_world_cam = known->second.T_world_cam;
      view.covariance = known->second.covariance;
      continue;
    }
    const bool by_board = observed.locations[v].pose.has_value();
    const bool stays = by_board && known != cameras_.end() && known->second.by_board &&
                       agree(known->second.T_world_cam, known->second.covariance, *view.T_world_cam,
                             view.covariance);
    if (stays) {
      view.T_world_cam = known->second.T_world_cam;
      view.covariance = known->second.covariance;
      continue;
    }
    if (by_board && known != cameras_.end()) {
      const double step_m =
          (view.T_world_cam->translation() - known->second.T_world_cam.translation()).norm();
      warnings.push_back(
          fmt::format("image {}: the camera was moved by {:.3f} m, or turned", image, step_m));
    }
    cameras_.insert_or_assign(image, Mounted{*view.T_world_cam, view.covariance, by_board});
  }
  return warnings;
}

}  // namespace vantage
