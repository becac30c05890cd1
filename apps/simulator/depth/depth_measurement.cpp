#include "simulator/depth/depth_measurement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulator/depth/normal_noise.hpp"
#include "simulator/scene/sample_hash.hpp"
#include "vantage/raycore/detail/multiversion.hpp"

namespace vantage::simulator::detail {
namespace {

constexpr std::size_t kBlock = 128;
constexpr std::size_t kTailBlock = 32;  // nine of ten have no number that far out

/// Standard normal numbers, one for each pixel.
[[gnu::always_inline]] inline void fill_noise_body(std::uint32_t first_pixel, std::uint32_t key0,
                                                   std::uint32_t key1, std::size_t count,
                                                   float* noise) {
  float x[kBlock], w[kBlock];
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = signed_unit(hash32(first_pixel + std::uint32_t(i), key0, key1));
    w[i] = -log_of((1 - x[i]) * (1 + x[i]));
    noise[i] = central_quantile(x[i], w[i]);
  }
  for (std::size_t i = 0; i < count; i += kTailBlock) {
    const std::size_t end = std::min(i + kTailBlock, count);
    int tails = 0;
    for (std::size_t k = i; k < end; ++k) tails |= int(w[k] >= kCentral);
    for (std::size_t k = i; tails != 0 && k < end; ++k) {
      if (w[k] >= kCentral) noise[k] = tail_quantile(x[k], std::sqrt(w[k]));
    }
  }
}
constexpr Multiversion<fill_noise_body> fill_noise;

/// To the nearest whole number, by what a float of this size has no room for.
[[gnu::always_inline]] inline float rounded(float x) {
  constexpr float kShift = 0x1.8p23f;
  return (x + kShift) - kShift;
}

[[gnu::always_inline]] inline bool any_known_body(const float* metres, std::size_t count) {
  int known = 0;
  for (std::size_t i = 0; i < count; ++i) known |= int(metres[i] == metres[i]);
  return known != 0;
}
constexpr Multiversion<any_known_body> any_known;

[[gnu::always_inline]] inline void measure_block_body(const DepthMeasurement::Numbers& n,
                                                      const float* noise, std::size_t count,
                                                      float* metres) {
  const float steps = n.step_px > 0 ? 1 / n.step_px : 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float disparity = n.focal_times_baseline / metres[i] + n.sigma_px * noise[i];
    const float stepped = steps > 0 ? rounded(disparity * steps) * n.step_px : disparity;
    const float depth = n.focal_times_baseline / stepped;
    const bool found =
        (stepped > 0) & (stepped <= n.max_disparity_px) & (depth >= n.near_m) & (depth <= n.far_m);
    metres[i] = found ? depth : DepthImage::kUnknown;
  }
}
constexpr Multiversion<measure_block_body> measure_block;

}  // namespace

DepthMeasurement::DepthMeasurement(const StereoSensor& sensor, const DepthRange& range,
                                   std::uint64_t seed)
    : exact_(sensor.noise.subpixel_px == 0 && sensor.disparity_step_px == 0 &&
             sensor.max_disparity_px == 0) {
  const std::uint64_t key = scatter(seed);
  numbers_ = {.focal_times_baseline = float(sensor.noise.focal_px * sensor.noise.baseline_m),
              .sigma_px = float(sensor.noise.subpixel_px),
              .step_px = float(sensor.disparity_step_px),
              .max_disparity_px = sensor.max_disparity_px > 0
                                      ? float(sensor.max_disparity_px)
                                      : std::numeric_limits<float>::infinity(),
              .near_m = float(range.near_m),
              .far_m = float(range.far_m),
              .key0 = std::uint32_t(key),
              .key1 = std::uint32_t(key >> 32)};
}

void DepthMeasurement::measure(float* metres, std::size_t count, std::uint32_t first_pixel) const {
  if (exact_) return;
  float noise[kBlock] = {};
  for (std::size_t i = 0; i < count; i += kBlock) {
    const std::size_t block = std::min(kBlock, count - i);
    if (!any_known(metres + i, block)) continue;
    if (numbers_.sigma_px > 0) {
      fill_noise(first_pixel + std::uint32_t(i), numbers_.key0, numbers_.key1, block, noise);
    }
    measure_block(numbers_, noise, block, metres + i);
  }
}

}  // namespace vantage::simulator::detail
