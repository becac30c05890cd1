#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/image.hpp"

namespace vantage {

/// Depth along the optical axis for every pixel, metres; NaN where it is unknown. Row-major.
class VANTAGE_API DepthImage {
 public:
  static constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

  /// Everything unknown.
  /// @throws Error bad_input unless both sizes are positive.
  DepthImage(int width, int height);

  /// Takes height x width depths. Zero and infinity become unknown.
  /// @throws Error bad_input if the count does not fit or a depth is negative.
  DepthImage(int width, int height, std::vector<float> metres, std::string_view where = "depth");

  /// The count by which many sensors say that they are saturated or have no reading.
  static constexpr std::uint16_t kSaturatedCount = 65535;

  /// Raw counts times `depth_scale_mm` are millimetres; counts of 0 and `kSaturatedCount` are
  /// unknown.
  /// @throws Error bad_input unless `depth_scale_mm` is finite and positive.
  static DepthImage from_counts(const RawDepthImage& counts, double depth_scale_mm,
                                std::string_view where = "depth");

  int width() const noexcept { return width_; }
  int height() const noexcept { return height_; }
  std::span<const float> metres() const noexcept { return metres_; }
  float at(int u, int v) const {
    return metres_[std::size_t(v) * std::size_t(width_) + std::size_t(u)];
  }
  void set(int u, int v, float metres) {
    metres_[std::size_t(v) * std::size_t(width_) + std::size_t(u)] = metres;
  }

 private:
  int width_;
  int height_;
  std::vector<float> metres_;
};

/// A camera and what it measured.
struct VANTAGE_API PosedDepth {
  /// Depths outside the camera's range count as unknown.
  /// @throws Error bad_input if the image and the camera's intrinsics differ in size.
  PosedDepth(const PinholeCamera& camera, std::shared_ptr<const DepthImage> depth,
             std::string_view where = "depth");

  PinholeCamera camera;
  std::shared_ptr<const DepthImage> depth;
};

}  // namespace vantage
