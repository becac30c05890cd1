#pragma once

#include <numbers>

namespace vantage {

inline constexpr double kMillimetres = 1000;                ///< in a metre
inline constexpr double kDegrees = 180 / std::numbers::pi;  ///< in a radian

}  // namespace vantage
