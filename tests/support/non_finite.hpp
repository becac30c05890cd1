#pragma once

#include <limits>

namespace vantage::test {

// What many an input must not be: as floats, which are doubles, too, without narrowing.
inline constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace vantage::test
