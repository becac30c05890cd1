#pragma once

#include <cstddef>
#include <cstdint>

#include "simulator/depth/depth_sensor.hpp"

namespace vantage::simulator::detail {

/// What the stereo matching makes of depths that both imagers see: noise, steps and limits.
class DepthMeasurement {
 public:
  DepthMeasurement(const StereoSensor& sensor, const DepthRange& range, std::uint64_t seed);

  /// Measures `count` depths in place, NaN stays NaN; the first belongs to pixel `first_pixel`, the
  /// others to those that follow it in the image.
  void measure(float* metres, std::size_t count, std::uint32_t first_pixel) const;

  struct Numbers {
    float focal_times_baseline;  ///< depth = this / disparity
    float sigma_px, step_px, max_disparity_px;
    float near_m, far_m;
    std::uint32_t key0, key1;
  };

 private:
  Numbers numbers_;
  bool exact_;
};

}  // namespace vantage::simulator::detail
