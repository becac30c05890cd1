#include "simulator/depth/depth_sensor.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <vector>

#include "simulator/depth/depth_measurement.hpp"
#include "simulator/depth/flying_pixels.hpp"
#include "simulator/depth/stereo_view.hpp"

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
