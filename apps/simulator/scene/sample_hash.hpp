#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace vantage {

/// Scatters 64 bits: every bit of the result depends on every bit of the key (the finaliser of
/// Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014: SplitMix64).
constexpr std::uint64_t scatter(std::uint64_t key) {
  key += 0x9E3779B97F4A7C15u;
  key = (key ^ (key >> 30)) * 0xBF58476D1CE4E5B9u;
  key = (key ^ (key >> 27)) * 0x94D049BB133111EBu;
  return key ^ (key >> 31);
}

/// A random number that belongs to (seed, index, ...): it does not matter who asks for it when.
template <class... Index>
constexpr std::uint64_t sample_hash(std::uint64_t seed, Index... index) {
  std::uint64_t key = scatter(seed);
  ((key = scatter(key ^ std::uint64_t(index))), ...);
  return key;
}

/// Uniform in [0, 1).
constexpr double to_unit(std::uint64_t hash) {
  return double(hash >> 11) * 0x1p-53;
}

/// Normal with mean 0 and standard deviation 1 (Box and Muller, 1958).
inline double to_normal(std::uint64_t hash) {
  const double radius = std::sqrt(-2 * std::log(1 - to_unit(hash)));  // never the logarithm of 0
  return radius * std::cos(2 * std::numbers::pi * to_unit(scatter(hash)));
}

}  // namespace vantage
