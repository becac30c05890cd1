#include "vantage/volume/stereo_sensor.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "vantage/raycore/error.hpp"

namespace vantage {

StereoSensor StereoSensor::ideal() {
  StereoSensor sensor;
  sensor.noise.subpixel_px = 0;
  sensor.disparity_step_px = sensor.max_disparity_px = 0;
  sensor.second_imager = sensor.projector = false;
  sensor.max_incidence_rad = std::numbers::pi / 2;
  sensor.border_px = 0;
  return sensor;
}

void StereoSensor::check(std::string_view where) const {
  const auto expect = [&](const char* field, double value, bool ok, const char* expected) {
    if (ok && std::isfinite(value)) return;
    throw bad_input(fmt::format("{}.{}", where, field),
                    fmt::format("found {}; expected {}", value, expected));
  };
  expect("noise.focal_px", noise.focal_px, noise.focal_px > 0, "more than 0");
  expect("noise.baseline_m", noise.baseline_m, noise.baseline_m > 0, "more than 0");
  expect("noise.subpixel_px", noise.subpixel_px, noise.subpixel_px >= 0, "0 or more");
  expect("disparity_step_px", disparity_step_px,
         disparity_step_px == 0 || (disparity_step_px >= 1e-4 && disparity_step_px <= 16),
         "0, or 0.0001 to 16");
  expect("max_disparity_px", max_disparity_px, max_disparity_px >= 0, "0 or more");
  expect("projector_m", projector_m, true, "a number");
  expect("max_incidence_rad", max_incidence_rad,
         max_incidence_rad > 0 && max_incidence_rad <= std::numbers::pi / 2 + 1e-12,
         "more than 0, up to π/2");
  expect("border_px", border_px, border_px >= 0, "0 or more");
  expect("flying_pixels", flying_pixels, flying_pixels >= 0 && flying_pixels <= 1, "0 to 1");
}

}  // namespace vantage
