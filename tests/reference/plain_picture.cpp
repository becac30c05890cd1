#include "reference/plain_picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vantage::test {
namespace {

Eigen::Vector3d linear(const Eigen::Vector3f& srgb) {
  return {linear_of(double(srgb.x())), linear_of(double(srgb.y())), linear_of(double(srgb.z()))};
}

/// Uniform in a disc of radius 1.
Eigen::Vector2d in_disc(Random& random) {
  const double angle = random.uniform(0, 2 * std::numbers::pi);
  return std::sqrt(random.uniform(0, 1)) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

/// A direction around `axis`, whose share `spread` of length lies beside it.
Eigen::Vector3d around(const Eigen::Vector3d& axis, const Eigen::Vector2d& beside, double along) {
  const Eigen::Vector3d side = axis.unitOrthogonal(), up = axis.cross(side);
  return beside.x() * side + beside.y() * up + along * axis;
}

bool on_line(const Material& material, const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
  if (material.line_spacing_m <= 0) return false;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(normal[axis]) > 0.7) continue;
    const double spacing = double(material.line_spacing_m);
    const double x = (p[axis] - double(material.line_origin[axis])) / spacing;
    if (std::abs(x - std::round(x)) * spacing < 0.5 * double(material.line_width_m)) return true;
  }
  return false;
}

double faded(const Material& material, const Eigen::Vector3d& p) {
  if (!std::isfinite(material.fade_to_m)) return 0;
  const double distance = (p - material.fade_centre.cast<double>()).norm();
  return std::clamp(double((float(distance) - material.fade_from_m) /
                           (material.fade_to_m - material.fade_from_m)),
                    0.0, 1.0);
}

bool reaches(const Scene& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& way) {
  return !scene.occluded(from.cast<float>(), (from + way).eval().cast<float>());
}

}  // namespace

double linear_of(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

Eigen::Vector3d plain_picture(const Scene& scene, std::span<const Material> materials,
                              const PinholeCamera& camera, const PictureOptions& options, int u,
                              int v, int count, Random& random) {
  const Eigen::Vector3d background = linear(options.background);
  const Eigen::Vector3d sun = options.to_sun.cast<double>().normalized();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < count; ++i) {
    const PixelRay ray =
        camera.pixel_ray(u + random.uniform(-0.5, 0.5), v + random.uniform(-0.5, 0.5));
    const auto hit =
        scene.closest_hit({camera.centre().cast<float>(), ray.direction.cast<float>()});
    if (!hit) {
      sum += background;
      continue;
    }
    const Eigen::Vector3d p = camera.centre() + double(hit->t) * ray.direction;
    Eigen::Vector3d normal = hit->normal.cast<double>();
    if (normal.dot(ray.direction) > 0) normal = -normal;
    const Eigen::Vector3d from = p + 1e-4 * std::max(0.1, double(hit->t)) * normal;
    const Eigen::Vector2d to_sky = in_disc(random);
    const Eigen::Vector3d sky =
        around(normal, to_sky, std::sqrt(std::max(1e-4, 1 - to_sky.squaredNorm())));
    const Eigen::Vector3d to_sun = around(sun, double(options.sun_radius) * in_disc(random), 1);
    const double facing = std::max(0.0, normal.dot(to_sun.normalized()));
    const double light =
        0.1 + (reaches(scene, from, double(options.sky_reach_m) * sky) ? 0.3 : 0) +
        (facing > 0 && reaches(scene, from, 100 * to_sun.normalized()) ? 0.6 * facing : 0);
    const Material& material = materials[hit->object];
    const double shade = on_line(material, p, normal) ? double(material.line_shade) : 1;
    const double gone = faded(material, p);
    sum += (1 - gone) * 1.12 * light * shade * linear(material.color) + gone * background;
  }
  return sum / count;
}

}  // namespace vantage::test
