#pragma once

#include <bit>
#include <cstdint>

namespace vantage::simulator::detail {

/// A 32-bit hash of a counter under a key, in steps that vector units have: two rounds of Wellons'
/// "lowbias32".
[[gnu::always_inline]] inline std::uint32_t hash32(std::uint32_t x, std::uint32_t key0,
                                                   std::uint32_t key1) {
  x ^= key0;
  x = (x ^ (x >> 16)) * 0x7FEB352Du;
  x = (x ^ (x >> 15)) * 0x846CA68Bu;
  x = (x ^ (x >> 16)) + key1;
  x = (x ^ (x >> 16)) * 0x7FEB352Du;
  x = (x ^ (x >> 15)) * 0x846CA68Bu;
  return x ^ (x >> 16);
}

/// A number in (-1, 1), never either end: the upper 23 bits, and half a step more.
[[gnu::always_inline]] inline float signed_unit(std::uint32_t hash) {
  return (float(std::int32_t(hash >> 9)) + 0.5f) * 0x1p-22f - 1.0f;
}

/// Natural logarithm of a positive, normal float, to about 1e-7 of it or 1e-7: branch-free, for
/// vector units. log x = e log 2 + 2 artanh((m - 1) / (m + 1)) with m in [√½, √2).
[[gnu::always_inline]] inline float log_of(float x) {
  const std::int32_t bits = std::bit_cast<std::int32_t>(x);
  const std::int32_t exponent = (bits - 0x3F3504F3) >> 23;
  const float m = std::bit_cast<float>(bits - (exponent << 23));
  const float s = (m - 1) / (m + 1), s2 = s * s;
  const float series = 1 + s2 * (1.0f / 3 + s2 * (1.0f / 5 + s2 * (1.0f / 7 + s2 * (1.0f / 9))));
  return float(exponent) * 0.693147181f + 2 * s * series;
}

/// Where w = -log(1 - x²) is below this, `central_quantile` holds: for 99.7 % of all x.
inline constexpr float kCentral = 5;

/// √2 · erf⁻¹(x), what a standard normal variable is where its distribution function is (1 + x) /
/// 2: Giles, "Approximating the erfinv function" (GPU Computing Gems 2, 2010), its single-precision
/// polynomial for the centre, to 4e-7 of the value.
[[gnu::always_inline]] inline float central_quantile(float x, float w) {
  const float q = w - 2.5f;
  float p = 2.81022636e-08f;
  p = 3.43273939e-07f + p * q;
  p = -3.5233877e-06f + p * q;
  p = -4.39150654e-06f + p * q;
  p = 0.00021858087f + p * q;
  p = -0.00125372503f + p * q;
  p = -0.00417768164f + p * q;
  p = 0.246640727f + p * q;
  p = 1.50140941f + p * q;
  return 1.41421356f * p * x;
}

/// The same for the tails; `root` is √w.
[[gnu::always_inline]] inline float tail_quantile(float x, float root) {
  const float q = root - 3;
  float p = -0.000200214257f;
  p = 0.000100950558f + p * q;
  p = 0.00134934322f + p * q;
  p = -0.00367342844f + p * q;
  p = 0.00573950773f + p * q;
  p = -0.0076224613f + p * q;
  p = 0.00943887047f + p * q;
  p = 1.00167406f + p * q;
  p = 2.83297682f + p * q;
  return 1.41421356f * p * x;
}

}  // namespace vantage::simulator::detail
