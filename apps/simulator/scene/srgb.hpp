#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace vantage {

/// The sRGB curve (IEC 61966-2-1), 0 to 1 on both sides: pictures store codes, light adds linearly.
inline float srgb_to_linear(float code) {
  return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

inline float linear_to_srgb(float light) {
  return light <= 0.0031308f ? 12.92f * light : 1.055f * std::pow(light, 1 / 2.4f) - 0.055f;
}

/// The nearest 8-bit code; light above 1 is white, below 0 black.
inline std::uint8_t linear_to_srgb8(float light) {
  if (!(light > 0)) return 0;
  return light >= 1 ? std::uint8_t(255) : std::uint8_t(255 * linear_to_srgb(light) + 0.5f);
}

/// What each of the 256 codes stands for.
inline std::array<float, 256> srgb8_to_linear() {
  std::array<float, 256> table;
  for (int code = 0; code < 256; ++code) table[code] = srgb_to_linear(float(code) / 255);
  return table;
}

}  // namespace vantage
