#include "tracking/detection.hpp"

#include <algorithm>

namespace vantage::reconstruction::detail {
namespace {

constexpr double kUnknown_m = 0.005, kUnknown_rad = 0.05;

Matrix6d unknown_noise() {
  Matrix6d noise = Matrix6d::Identity();
  noise.topLeftCorner<3, 3>() *= kUnknown_m * kUnknown_m;
  noise.bottomRightCorner<3, 3>() *= kUnknown_rad * kUnknown_rad;
  return noise;
}

PoseMeasurement measured(const ReconstructedObject& object) {
  if (!object.covariance) return {object.T_world_object, unknown_noise(), Matrix6d::Zero()};
  const Matrix6d noise = object.noise_covariance.value_or(*object.covariance);
  return {object.T_world_object, noise, without_negative(*object.covariance - noise)};
}

}  // namespace

std::vector<Detection> detections_of(const Reconstruction& snapshot,
                                     std::span<const CameraView> views) {
  std::vector<Detection> detections;
  for (const ReconstructedObject& object : snapshot.objects) {
    Detection detection{&object, {{object.type, measured(object), object.probability}}, {}};
    for (const Alternative& other : object.alternatives) {
      PoseMeasurement pose = detection.poses.front().measured;  // about as well known
      pose.T_world_object = other.T_world_object;
      detection.poses.push_back({other.type, pose, other.probability});
    }
    for (std::size_t v = 0; v < views.size(); ++v) {
      const bool sees = std::ranges::any_of(
          object.support, [&](const Support& support) { return support.id.view == v; });
      if (sees) detection.views.push_back(v);
    }
    detections.push_back(std::move(detection));
  }
  return detections;
}

}  // namespace vantage::reconstruction::detail
