#include "metrics/bop/visible_discrepancy.hpp"

#include <fmt/format.h>

#include <cmath>

#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr DepthRange kEverywhere{0.01, 100};  // metres; the renderer is no sensor

/// Distances along the rays; 0 where the depth is unknown.
std::vector<double> ranges_of(const DepthImage& depth, const Intrinsics& k) {
  std::vector<double> ranges;
  ranges.reserve(depth.metres().size());
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const double z = double(depth.at(u, v));
      const double x = (u - k.cx) / k.fx, y = (v - k.cy) / k.fy;
      ranges.push_back(std::isnan(z) ? 0 : z * std::sqrt(x * x + y * y + 1));
    }
  }
  return ranges;
}

std::vector<bool> visible(const ObjectView& object, const std::vector<double>& scene,
                          double delta_m) {
  std::vector<bool> mask(scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const double range = object.range_m[i];
    mask[i] = range > 0 && (scene[i] == 0 || range - scene[i] <= delta_m);
  }
  return mask;
}

void check_size(const DepthImage& scene, const Intrinsics& camera) {
  if (scene.width() == camera.width && scene.height() == camera.height) return;
  throw bad_input("scene depth",
                  fmt::format("it has {} x {} pixels; expected {} x {}, as the camera has",
                              scene.width(), scene.height(), camera.width, camera.height));
}

}  // namespace

std::vector<double> bop_thresholds() {
  std::vector<double> thresholds;
  for (int i = 1; i <= 10; ++i) thresholds.push_back(0.05 * i);
  return thresholds;
}

ObjectView view_of(const TriangleMesh& mesh, const Pose& T_cam_object, const Intrinsics& camera) {
  SceneBuilder builder;
  builder.add_mesh(mesh.transformed(T_cam_object));
  const PinholeCamera at_origin(camera, Pose(), kEverywhere);
  return {ranges_of(builder.build()->render_depth(at_origin), camera)};
}

std::vector<bool> visible_mask(const ObjectView& object, const DepthImage& scene,
                               const Intrinsics& camera, double delta_m) {
  check_size(scene, camera);
  return visible(object, ranges_of(scene, camera), delta_m);
}

double visible_fraction(const ObjectView& object, const DepthImage& scene, const Intrinsics& camera,
                        double delta_m) {
  const std::vector<bool> mask = visible_mask(object, scene, camera, delta_m);
  std::size_t covered = 0, seen = 0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    covered += object.range_m[i] > 0;
    seen += mask[i];
  }
  return covered > 0 ? double(seen) / double(covered) : 0;
}

std::vector<double> vsd(const ObjectView& estimate, const ObjectView& truth,
                        const DepthImage& scene, const Intrinsics& camera, double diameter_m,
                        const VsdOptions& options) {
  check_size(scene, camera);
  const std::vector<double> ranges = ranges_of(scene, camera);
  const std::vector<bool> seen_true = visible(truth, ranges, options.delta_m);
  const std::vector<bool> before = visible(estimate, ranges, options.delta_m);
  std::size_t either = 0;
  std::vector<double> misaligned;  // shares of the diameter, where both are seen
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    // The true object's own surface hides nothing of the estimate.
    const bool seen_estimate = before[i] || (seen_true[i] && estimate.range_m[i] > 0);
    either += seen_true[i] || seen_estimate;
    if (seen_true[i] && seen_estimate) {
      misaligned.push_back(std::abs(truth.range_m[i] - estimate.range_m[i]) / diameter_m);
    }
  }
  std::vector<double> errors;
  for (const double tau : options.taus) {
    std::size_t wrong = either - misaligned.size();
    for (const double distance : misaligned) wrong += distance >= tau;
    errors.push_back(either > 0 ? double(wrong) / double(either) : 1);
  }
  return errors;
}

}  // namespace vantage
