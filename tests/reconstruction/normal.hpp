#pragma once

#include <cmath>
#include <numbers>

#include "reference/random_scene.hpp"

namespace vantage::test {

/// Standard normal (Box and Muller), the same with every standard library.
inline double normal(Random& random) {
  const double radius = std::sqrt(-2 * std::log(1 - random.uniform(0, 1)));
  return radius * std::cos(random.uniform(0, 2 * std::numbers::pi));
}

}  // namespace vantage::test
