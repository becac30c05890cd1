#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "simulator/sample_hash.hpp"

namespace vantage {

/// Two numbers in [-0.5, 0.5).
struct SquarePoint {
  float x, y;
};

/// What one sample of a pixel looks at besides the surface itself.
struct LightSample {
  SquarePoint lamp;           ///< on the lamp, in units of its sides
  float sky_x, sky_y, sky_z;  ///< unit vector, density cos/π around z = the surface's normal
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
    for (std::size_t s = 0; s < samples_; ++s) position_.push_back(lattice(s));
    light_.resize(patterns_ * samples_);
    for (std::size_t p = 0; p < patterns_; ++p) fill(p);
  }

  std::size_t samples_per_pixel() const { return samples_; }

  /// Where in its pixel a sample lies, from the centre; one sample lies at the centre.
  const SquarePoint& position(std::size_t sample) const { return position_[sample]; }

  /// The `samples_per_pixel()` light samples of a pixel, numbered in reading order.
  const LightSample* light_of_pixel(std::uint64_t pixel) const {
    return light_.data() + sample_hash(seed_, kPatterns, pixel) % patterns_ * samples_;
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
      light_[pattern * samples_ + s] = {lamp[s], float(radius * std::cos(angle)),
                                        float(radius * std::sin(angle)),
                                        float(std::sqrt(std::max(1e-6, 1 - squared)))};
    }
  }

  std::size_t samples_, patterns_;
  std::uint64_t seed_;
  std::vector<SquarePoint> position_;
  std::vector<LightSample> light_;  ///< pattern by pattern
};

}  // namespace vantage
