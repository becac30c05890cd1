#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <string>

namespace vantage::raycore::detail {

/// No mesh reaches further from its origin, metres: beyond it a float is off by 3 cm and more.
inline constexpr double kMaxCoordinate = 1e6;

/// False for NaN, too.
template <class Vector>
bool is_coordinate(const Vector& p) {
  return std::abs(p.x()) < kMaxCoordinate && std::abs(p.y()) < kMaxCoordinate &&
         std::abs(p.z()) < kMaxCoordinate;
}

/// "(1, 2.5, nan)", with every digit that the value has.
template <class Vector>
std::string to_text(const Vector& p) {
  return fmt::format("({}, {}, {})", p.x(), p.y(), p.z());
}

}  // namespace vantage::raycore::detail
