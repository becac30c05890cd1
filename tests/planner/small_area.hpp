#pragma once

#include "vantage/raycore/box.hpp"

namespace vantage::test {

/// A work area of 20 cm along each edge on the floor.
inline const Box kSmallArea({-0.1, -0.1, 0}, {0.1, 0.1, 0.2});

}  // namespace vantage::test
