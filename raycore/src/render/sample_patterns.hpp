#pragma once

#include <Eigen/Core>
#include <vector>

#include "vantage/raycore/advanced/picture.hpp"

namespace vantage::raycore::detail {

/// Where a sample of a pixel looks for light.
struct LightDirections {
  Eigen::Vector3f to_sky;  ///< over the hemisphere around z, density cos/π
  Eigen::Vector3f to_sun;  ///< within the sun's disc, world frame, unit length
};

/// The samples of a pixel: positions that are the same in all pixels, so that edges are clean, and
/// light directions that come in 4 × 4 patterns. Each pattern covers the sky and the sun evenly,
/// and so do those of any 4 × 4 neighbouring pixels together: what one pixel's few samples leave
/// uneven is even in the mean of its neighbours (interleaved sampling: Keller, Heidrich, 2001).
///
/// All are points of the (0, 2)-sequence of Sobol's first two dimensions; within a pattern the
/// order for sky and sun is shuffled, so that neither is correlated with the position.
class SamplePatterns {
 public:
  static constexpr int kSide = 4;

  SamplePatterns(int samples, const PictureOptions& options);

  int samples() const { return int(positions_.size()); }

  /// In pixels from the pixel's centre; a single sample lies there.
  const Eigen::Vector2f& position(int sample) const { return positions_[std::size_t(sample)]; }

  const std::vector<Eigen::Vector2f>& positions() const { return positions_; }

  const LightDirections& light(int u, int v, int sample) const {
    const std::size_t pattern = std::size_t(v % kSide * kSide + u % kSide);
    return light_[pattern * positions_.size() + std::size_t(sample)];
  }

 private:
  std::vector<Eigen::Vector2f> positions_;
  std::vector<LightDirections> light_;  ///< pattern by pattern
};

}  // namespace vantage::raycore::detail
