#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>

namespace vantage::raycore::detail {

/// What an sRGB colour stands for (IEC 61966-2-1), 0 to 1.
inline Eigen::Vector3f to_linear(const Eigen::Vector3f& srgb) {
  return srgb.unaryExpr(
      [](float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); });
}

/// Linear light to its nearest 8-bit code without a power: the code where the light's 4096th
/// begins, and the few bounds between codes that lie within it. Light above 1 is white.
class SrgbTable {
 public:
  SrgbTable() {
    for (int code = 1; code < 256; ++code) {
      const double between = (code - 0.5) / 255;
      bounds_[code] =
          float(between <= 0.04045 ? between / 12.92 : std::pow((between + 0.055) / 1.055, 2.4));
    }
    bounds_[256] = 2;
    for (int part = 0, code = 0; part <= kParts; ++part) {
      while (bounds_[code + 1] <= float(part) / kParts) ++code;
      first_[part] = std::uint8_t(code);
    }
  }

  std::uint8_t operator()(float light) const {
    if (!(light > 0)) return 0;
    if (light >= 1) return 255;
    int code = first_[int(light * kParts)];
    while (light >= bounds_[code + 1]) ++code;
    return std::uint8_t(code);
  }

 private:
  static constexpr int kParts = 4096;
  std::array<float, 257> bounds_ = {};  ///< the least light of each code, and one that none has
  std::array<std::uint8_t, kParts + 1> first_ = {};
};

}  // namespace vantage::raycore::detail
