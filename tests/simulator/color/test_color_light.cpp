// The lamp's light and shadow against closed forms, and the noise against its definition.

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <array>

#include "simulator/color_scenes.hpp"

namespace vantage::test {
namespace {

using Corners = std::array<Eigen::Vector3d, 4>;

/// A lamp that hangs straight above the floor.
Lighting lamp_above(double height_m) {
  Lighting lighting;
  lighting.lamp_centre_m = {0, 0, float(height_m)};
  lighting.lamp_target_m = {0, 0, 0};
  return lighting;
}

Corners corners_of(const Lighting& lighting) {
  const double h = lighting.lamp_side_m / 2, z = lighting.lamp_centre_m.z();
  return {Eigen::Vector3d(-h, -h, z), {-h, h, z}, {h, h, z}, {h, -h, z}};
}

/// ∫ cos·cos'/r² over a polygon above the horizon (Lambert, "Photometria", 1760): half the sum over
/// its edges of the angle that each is seen under, times its plane's cosine with the normal.
double polygon_light(const Eigen::Vector3d& position, const Eigen::Vector3d& normal,
                     const Corners& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d a = (corners[i] - position).normalized();
    const Eigen::Vector3d b = (corners[(i + 1) % corners.size()] - position).normalized();
    sum += std::acos(a.dot(b)) * a.cross(b).normalized().dot(normal) / 2;
  }
  return std::abs(sum);
}

/// Seen from the side, so that the lamp and the camera are apart.
const PinholeCamera kFromTheSide({96, 72, 80, 80, 47.5, 35.5},
                                 Pose::looking_at({0.5, -1.2, 0.9}, {0, 0, 0}));

Eigen::Vector3d on_floor(const PinholeCamera& camera, int u, int v) {
  const PixelRay ray = camera.pixel_ray(u, v);
  return ray.origin - ray.origin.z() / ray.direction.z() * ray.direction;
}

}  // namespace

TEST_CASE("a matt floor with nothing around has the grey of the closed form") {
  const auto scene = SimulatedScene({picture_body(40, 40, ColorImage(1, 1, 230))});
  // Four points stand for the lamp: one per cent off where it is about as near as it is wide.
  for (const auto& [height, tolerance] : {std::pair{0.8, 1.5}, {1.6, 1.0}}) {
    const Lighting lighting = lamp_above(height);
    const Corners corners = corners_of(lighting);
    const Eigen::Vector3d up(0, 0, 1);
    const double at_target = polygon_light({0, 0, 0}, up, corners);
    const auto image = simulate_color(scene, lighting, kFromTheSide, ColorSensor{}, 1);
    for (int v = 0; v < image->height; ++v) {
      for (int u = 0; u < image->width; ++u) {
        if (kFromTheSide.pixel_ray(u, v).direction.z() > -0.2) continue;  // pixels of many metres
        const Eigen::Vector3d p = on_floor(kFromTheSide, u, v);
        const double lamp = polygon_light(p, up, corners) / at_target;
        const double light = lighting.exposure *
                             (lighting.lamp_share * lamp + 1 - lighting.lamp_share) * light_of(230);
        CHECK(std::abs(image->pixel(u, v)[0] - code_of(light)) <= tolerance);
      }
    }
  }
}

TEST_CASE("a shadow's edge lies where the lamp's corners and the edge of what throws it say") {
  Lighting lighting = lamp_above(1.6);
  lighting.lamp_centre_m.x() = lighting.lamp_target_m.x() = 0.3f;  // the shadow falls towards -x
  lighting.lamp_share = 1;
  const double edge_height = 0.4;
  const auto scene =
      SimulatedScene({picture_body(4, 4, ColorImage(1, 1, 255)),
                      box_body(Box({-3, -2, edge_height}, {0, 2, 0.41}), {0, 0, 0})});
  double umbra = 0, penumbra = -1;  // x on the floor
  for (Eigen::Vector3d corner : corners_of(lighting)) {
    corner.x() += 0.3;
    // The box's lower edge throws the umbra's end, the upper one what is nearly the penumbra's.
    const double x = -corner.x() * edge_height / (corner.z() - edge_height);
    umbra = std::min(umbra, x), penumbra = std::max(penumbra, x);
  }
  // From below the box, which would hide the floor from above.
  const PinholeCamera camera({200, 20, 200, 200, 99.5, 9.5},
                             Pose::looking_at({0.2, -0.9, 0.25}, {-0.05, 0, 0}));
  ColorSensor sensor;
  sensor.samples_per_pixel = 64;
  const auto image = simulate_color(scene, lighting, camera, sensor, 1);
  int dark = 0, half = 0, lit = 0;
  for (int v = 0; v < image->height; ++v) {
    for (int u = 0; u < image->width; ++u) {
      const Eigen::Vector3d p = on_floor(camera, u, v);
      if (std::abs(p.x()) > 1 || std::abs(p.y()) > 0.5) continue;
      const double unshadowed =
          lighting.exposure *
          polygon_light(p - Eigen::Vector3d(0.3, 0, 0), {0, 0, 1}, corners_of(lighting)) /
          polygon_light({0, 0, 0}, {0, 0, 1}, corners_of(lighting));
      const double seen = light_of(image->pixel(u, v)[0]) / unshadowed;
      CAPTURE(p.x());
      constexpr double kPixel = 0.012;  // metres on the floor
      if (p.x() < umbra - kPixel) {
        ++dark;
        CHECK(seen == 0);
      }
      if (p.x() > penumbra + kPixel) {
        ++lit;
        CHECK(seen == doctest::Approx(1).epsilon(0.01));
      }
      if (p.x() > umbra && p.x() < penumbra) {
        // The part of a square lamp beyond an edge that is parallel to its sides.
        const double expected = (p.x() - umbra) / (penumbra - umbra);
        ++half;
        CHECK(std::abs(seen - expected) < 0.08);
      }
    }
  }
  CHECK(dark > 200);
  CHECK(half > 200);
  CHECK(lit > 200);
}

TEST_CASE("noise has the stated deviation and nothing in common with its neighbours") {
  const double light = light_of(188);
  const auto scene = SimulatedScene({picture_body(4, 4, ColorImage(1, 1, 188))});
  const PinholeCamera camera({640, 480, 600, 600, 320, 240},
                             Pose::looking_at({0, 0, 2}, {0, 0, 0}));
  for (const auto& [read, shot] : {std::pair{0.03, 0.0}, {0.0, 0.002}, {0.02, 0.001}}) {
    ColorSensor sensor;
    sensor.samples_per_pixel = 1;
    sensor.read_noise = read, sensor.shot_noise = shot;
    const ColorImage image = *simulate_color(scene, even_light(), camera, sensor, 9);
    double sum = 0, squares = 0, beside = 0, below = 0;
    const std::size_t count = image.samples.size(), row = 3 * 640;
    for (std::size_t i = 0; i < count; ++i) {
      const double off = light_of(image.samples[i]) - light;
      sum += off, squares += off * off;
      if (i + 1 < count) beside += off * (light_of(image.samples[i + 1]) - light);
      if (i + row < count) below += off * (light_of(image.samples[i + row]) - light);
    }
    const double sigma = std::sqrt(read * read + shot * light);
    CHECK(std::sqrt(squares / double(count)) == doctest::Approx(sigma).epsilon(0.03));
    CHECK(std::abs(sum / double(count)) < 0.02 * sigma);
    CHECK(std::abs(beside / squares) < 0.005);
    CHECK(std::abs(below / squares) < 0.005);
  }
}

}  // namespace vantage::test
