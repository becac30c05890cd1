#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "simulator/scene/sample_hash.hpp"

namespace vantage {

/// Two numbers in [-0.5, 0.5).
struct SquarePoint {
  float x, y;
};

/// What the samples of a pixel look at besides the surface itself: one array per coordinate.
struct LightSamples {
  const float *lamp_x, *lamp_y;        ///< on the lamp, in units of its sides, -0.5 to 0.5
  const float *sky_x, *sky_y, *sky_z;  ///< unit vectors, density cos/π around z = the normal
};

/// The samples of a picture. All pixels are sampled at the same positions, so that edges are clean;
/// each picks by its hash one of many patterns of light samples. In a pattern, the samples cover
/// the lamp and the hemisphere evenly (a golden-ratio lattice, shifted at random around the square)
/// in an order that is shuffled for each, so that little noise is left and none of it has a shape.
class SampleTable {
 public:
  SampleTable(int samples_per_pixel, std::uint64_t seed)
      : samples_(std::size_t(samples_per_pixel)),
        patterns_(std::max<std::size_t>(16, 4096 / samples_)),
        seed_(seed) {
    for (std::size_t s = 0; s < samples_; ++s) {
      const SquarePoint p = lattice(s);
      position_x_.push_back(p.x), position_y_.push_back(p.y);
    }
    for (std::vector<float>& numbers : light_) numbers.resize(patterns_ * samples_);
    for (std::size_t p = 0; p < patterns_; ++p) fill(p);
  }

  std::size_t samples_per_pixel() const { return samples_; }

  /// Where in its pixel each sample lies, pixels from the centre; a single one lies there.
  const float* position_x() const { return position_x_.data(); }
  const float* position_y() const { return position_y_.data(); }

  /// The `samples_per_pixel()` light samples of a pixel, whose number counts in reading order.
  LightSamples of_pixel(std::uint64_t pixel) const {
    const std::size_t first = sample_hash(seed_, kPatterns, pixel) % patterns_ * samples_;
    return {light_[0].data() + first, light_[1].data() + first, light_[2].data() + first,
            light_[3].data() + first, light_[4].data() + first};
  }

 private:
  enum Purpose : std::uint64_t { kPatterns, kLamp, kSky };

  static float wrapped(double x) { return float(x - std::floor(x + 0.5)); }

  /// Symmetric about the centre: no sample pattern shifts the picture.
  SquarePoint lattice(std::size_t s, double shift_x = 0, double shift_y = 0) const {
    const double from_middle = double(s) - 0.5 * double(samples_ - 1);
    return {wrapped(from_middle / double(samples_) + shift_x),
            wrapped(from_middle / std::numbers::phi + shift_y)};
  }

  std::vector<SquarePoint> shuffled_lattice(Purpose purpose, std::size_t pattern) const {
    const double x = to_unit(sample_hash(seed_, purpose, pattern, 0));
    const double y = to_unit(sample_hash(seed_, purpose, pattern, 1));
    std::vector<SquarePoint> points;
    for (std::size_t s = 0; s < samples_; ++s) points.push_back(lattice(s, x, y));
    for (std::size_t s = samples_; s > 1; --s) {  // Fisher and Yates
      std::swap(points[s - 1], points[sample_hash(seed_, purpose, pattern, s) % s]);
    }
    return points;
  }

  void fill(std::size_t pattern) {
    const std::vector<SquarePoint> lamp = shuffled_lattice(kLamp, pattern);
    const std::vector<SquarePoint> sky = shuffled_lattice(kSky, pattern);
    for (std::size_t s = 0; s < samples_; ++s) {
      const double angle = 2 * std::numbers::pi * (sky[s].x + 0.5), squared = sky[s].y + 0.5;
      const double radius = std::sqrt(squared);
      const double numbers[] = {lamp[s].x, lamp[s].y, radius * std::cos(angle),
                                radius * std::sin(angle), std::sqrt(std::max(1e-6, 1 - squared))};
      for (int i = 0; i < 5; ++i) light_[i][pattern * samples_ + s] = float(numbers[i]);
    }
  }

  std::size_t samples_, patterns_;
  std::uint64_t seed_;
  std::vector<float> position_x_, position_y_;
  std::array<std::vector<float>, 5> light_;  ///< as in LightSamples, pattern by pattern
};

}  // namespace vantage
