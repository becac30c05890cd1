#include "simulator/depth/depth_sensor.hpp"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "simulator/depth/depth_measurement.hpp"
#include "simulator/depth/flying_pixels.hpp"
#include "simulator/depth/stereo_view.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

using simulator::detail::kBandRows;

/// Calls `band(first_row, rows)` for all bands of an image, in parallel.
template <class Band>
void for_each_band(int height, const Band& band) {
  tbb::parallel_for(0, (height + kBandRows - 1) / kBandRows, [&](int b) {
    band(b * kBandRows, std::min(kBandRows, height - b * kBandRows));
  });
}

}  // namespace

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

DepthImage simulate_depth(const Scene& scene, const PinholeCamera& camera,
                          const StereoSensor& sensor, std::uint64_t seed) {
  sensor.check("depth sensor");
  const int width = camera.intrinsics().width, height = camera.intrinsics().height;
  const simulator::detail::StereoView view(scene, camera, sensor);
  const simulator::detail::DepthMeasurement measurement(sensor, camera.range(), seed);
  std::vector<float> metres(std::size_t(width) * std::size_t(height));
  const auto measure = [&](int first_row, int rows) {
    const std::size_t first = std::size_t(first_row) * std::size_t(width);
    measurement.measure(metres.data() + first, std::size_t(rows) * std::size_t(width),
                        std::uint32_t(first));
  };

  const bool flying = sensor.flying_pixels > 0;
  tbb::enumerable_thread_specific<simulator::detail::StereoView::Scratch> scratch;
  for_each_band(height, [&](int first_row, int rows) {
    view.fill_band(first_row / kBandRows, scratch.local(), metres.data());
    if (!flying) measure(first_row, rows);
  });
  if (flying) {
    simulator::detail::add_flying_pixels(metres, width, height, sensor.flying_pixels, seed);
    for_each_band(height, measure);
  }
  return DepthImage(width, height, std::move(metres), "depth sensor");
}

}  // namespace vantage
