#include "vantage/volume/volume_options.hpp"

#include <fmt/format.h>

#include <cmath>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

void check_number(const char* key, double value, bool valid, const char* expected) {
  if (std::isfinite(value) && valid) return;
  throw bad_input(key, fmt::format("is {}; expected a finite number, {}", value, expected));
}

}  // namespace

void StereoNoise::check() const {
  check_number("noise.focal_px", focal_px, focal_px > 0, "above 0");
  check_number("noise.baseline_m", baseline_m, baseline_m > 0, "above 0");
  check_number("noise.subpixel_px", subpixel_px, subpixel_px >= 0, "0 or above");
}

void VolumeOptions::check() const {
  check_number("band_sigmas", band_sigmas, band_sigmas >= 0, "0 or above");
  check_number("filter_m", filter_m, filter_m >= 0, "0 or above");
  noise.check();
}

}  // namespace vantage
