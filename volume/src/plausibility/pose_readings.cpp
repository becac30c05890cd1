#include "plausibility/pose_readings.hpp"

#include <array>

namespace vantage::volume::detail {
namespace {

constexpr std::array kReadings = {
    PoseReading{"camera-to-world poses were given where world-to-camera is expected; invert them",
                true, false, 1},
    PoseReading{"the poses have OpenGL's axes (y up, looking along -z) where OpenCV's are expected "
                "(x right, y down, z forward); flip y and z",
                false, true, 1},
    PoseReading{"camera-to-world poses with OpenGL's axes (y up, looking along -z) were given, as "
                "rendering tools write them, where world-to-camera with x right, y down, z forward "
                "is expected; `vantage import` converts them",
                true, true, 1},
    PoseReading{"the translations are in metres where millimetres are expected (cam_t_w2c); "
                "multiply them by 1000",
                false, false, 1000},
    PoseReading{"the translations are 1000 times too large (cam_t_w2c is in millimetres)", false,
                false, 0.001},
    PoseReading{"camera-to-world poses in metres were given where world-to-camera in millimetres "
                "is expected",
                true, false, 1000},
    PoseReading{"camera-to-world poses with OpenGL's axes in metres were given where "
                "world-to-camera in millimetres is expected; `vantage import` converts them",
                true, true, 1000},
};

/// The share of a camera's readings that lie in a box.
double measured_in(const Box& box, const SampledCamera& camera, const PinholeCamera& posed) {
  std::size_t inside = 0;
  for (const DepthSample& sample : camera.depths) {
    inside += box.contains(posed.unproject(sample.u, sample.v, sample.depth_m));
  }
  return camera.depths.empty() ? 0 : double(inside) / double(camera.depths.size());
}

}  // namespace

Pose PoseReading::of(const Pose& T_world_cam) const {
  const Pose meant = inverted ? T_world_cam.inverse() : T_world_cam;
  Eigen::Matrix3d rotation = meant.rotation();
  if (opengl) rotation.rightCols<2>() *= -1;
  return Pose::from_rotation(rotation, scale * meant.translation());
}

std::span<const PoseReading> pose_readings() {
  return kReadings;
}

AreaFit fit_of(const std::vector<const SampledCamera*>& cameras, const PoseReading* reading,
               const Box& work_area) {
  constexpr double kSeen = 0.15;
  const std::vector<Eigen::Vector3d> points = area_samples(work_area);
  const Box near = grown(work_area, 0.1);
  AreaFit fit;
  for (const SampledCamera* camera : cameras) {
    const PinholeCamera& given = camera->camera->camera;
    const PinholeCamera posed = reading ? given.moved_to(reading->of(given.T_world_cam())) : given;
    const double coverage = coverage_of(posed, points);
    fit.coverage += coverage / double(cameras.size());
    fit.measured += measured_in(near, *camera, posed) / double(cameras.size());
    fit.seeing += coverage >= kSeen;
  }
  return fit;
}

const PoseReading* better_reading(const std::vector<const SampledCamera*>& cameras,
                                  const Box& work_area) {
  const PoseReading* best = nullptr;
  double best_score = 0;
  for (const PoseReading& reading : kReadings) {
    const AreaFit fit = fit_of(cameras, &reading, work_area);
    if (2 * fit.seeing < cameras.size() || fit.seeing == 0 || fit.score() <= best_score) continue;
    best = &reading;
    best_score = fit.score();
  }
  return best;
}

}  // namespace vantage::volume::detail
