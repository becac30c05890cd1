#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace vantage::test {

/// The sanitizers take ten times as long, and look for other things than wrong results.
#ifdef VANTAGE_SANITIZED  // by CMake: compilers have each their own word for it
inline constexpr bool kAllScenes = false;
#else
inline constexpr bool kAllScenes = true;
#endif

/// For `doctest::skip`: what takes long under the sanitizers, and has a shorter case of its kind.
inline constexpr bool kSanitized = !kAllScenes;

/// How many scenes to look at: all, or a twentieth of them under the sanitizers, which
/// look for slips in memory and not for right results.
inline std::uint32_t scene_count(std::uint32_t all) {
  return kAllScenes ? all : std::max(all / 20, std::uint32_t(1));
}

/// How often something has to have happened in all scenes for the test to be worth something; a few
/// scenes need not show it.
inline std::size_t enough(std::size_t in_all_scenes) {
  return kAllScenes ? in_all_scenes : 0;
}

}  // namespace vantage::test
