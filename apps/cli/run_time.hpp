#pragma once

#include <chrono>
#include <cmath>

#include "vantage/raycore/stop_token.hpp"

namespace vantage {

inline double seconds_since(StopToken::Clock::time_point start) {
  return std::chrono::duration<double>(StopToken::Clock::now() - start).count();
}

/// To the microsecond.
inline double milliseconds(double seconds) {
  return std::round(seconds * 1e6) / 1e3;
}

}  // namespace vantage
