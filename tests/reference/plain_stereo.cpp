#include "reference/plain_stereo.hpp"

#include <cmath>

namespace vantage::test {
namespace {

constexpr double kOffSurface = 1e-4;

}  // namespace

DepthImage PlainStereo::see(const Scene& scene, const PinholeCamera& camera) const {
  const Intrinsics& k = camera.intrinsics();
  const Eigen::Vector3d x = camera.T_world_cam().rotation().col(0);
  const Eigen::Vector3d imager = camera.centre() + baseline_m * x;
  const Eigen::Vector3d projector = camera.centre() + projector_m * x;
  const auto inside = [&](double u, double v) {
    return u >= border_px && u <= k.width - 1 - border_px && v >= border_px &&
           v <= k.height - 1 - border_px;
  };
  DepthImage image(k.width, k.height);
  for (int v = 0; v < k.height; ++v) {
    for (int u = 0; u < k.width; ++u) {
      const PixelRay ray = camera.pixel_ray(u, v);
      const auto hit = scene.closest_hit({ray.origin.cast<float>(), ray.direction.cast<float>()});
      if (!hit || hit->t < camera.range().near_m || hit->t > camera.range().far_m) continue;
      if (!inside(u, v) || !inside(u - k.fx * baseline_m / double(hit->t), v)) continue;
      Eigen::Vector3d normal = hit->normal.cast<double>();
      if (normal.dot(ray.direction) > 0) normal = -normal;
      const double cosine = -normal.dot(ray.direction) / ray.direction.norm();
      if (cosine < std::cos(max_incidence_rad)) continue;
      const Eigen::Vector3d from = ray.origin + double(hit->t) * ray.direction +
                                   kOffSurface * std::max(0.1, double(hit->t)) * normal;
      if (scene.occluded(from.cast<float>(), imager.cast<float>())) continue;
      if (scene.occluded(from.cast<float>(), projector.cast<float>())) continue;
      image.set(u, v, hit->t);
    }
  }
  return image;
}

}  // namespace vantage::test
