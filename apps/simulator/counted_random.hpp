#pragma once

#include <cstdint>
#include <initializer_list>

namespace vantage {

/// A number in 0 ≤ u < 1 that depends on nothing but these counts, e.g. (seed, body, try, which):
/// the order in which they are drawn cannot matter. Each is mixed in by the finaliser of Steele et
/// al., "Fast splittable pseudorandom number generators", 2014 (SplitMix64).
inline double counted_random(std::initializer_list<std::uint64_t> counts) {
  std::uint64_t state = 0;
  for (const std::uint64_t count : counts) {
    state = (state ^ count) + 0x9e3779b97f4a7c15;
    state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9;
    state = (state ^ (state >> 27)) * 0x94d049bb133111eb;
    state ^= state >> 31;
  }
  return double(state >> 11) * 0x1p-53;
}

}  // namespace vantage
