#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/points.hpp"
#include "vantage/raycore/scene.hpp"

namespace vantage::test {

/// Which points a view sees, the obvious way: point by point, each with its own test against the
/// image and the depth range and, if it passes, its own ray. 1 or 0 for each.
std::vector<std::uint8_t> plain_visible(PointsView points, const Scene& occluders,
                                        const PinholeCamera& view);

/// How many points each of the views sees.
std::vector<std::uint64_t> plain_scores(PointsView points, const Scene& occluders,
                                        std::span<const PinholeCamera> views);

}  // namespace vantage::test
