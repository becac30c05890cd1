#pragma once

#include <cstdint>
#include <vector>

#include "vantage/raycore/points.hpp"

namespace vantage::detail {

/// The points' places along a Z-shaped curve through their box, so that neighbours in the order are
/// neighbours in space; among equals as given.
std::vector<std::uint32_t> z_curve_order(PointsView points);

}  // namespace vantage::detail
