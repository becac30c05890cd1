#pragma once

#include <algorithm>
#include <cstdint>

namespace vantage::test {

/// How many random scenes to look at: all, or some under the sanitizers, which take ten times
/// as long and look for other things.
inline std::uint32_t scene_count(std::uint32_t all) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return std::max(all / 6, std::min<std::uint32_t>(all, 2));
#else
  return all;
#endif
}

}  // namespace vantage::test
