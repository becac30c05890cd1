#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "vantage/raycore/pose.hpp"

namespace vantage::test {

/// How far a view is from where polishing began: around, over, pan, tilt, radians.
using PolishAngles = std::array<double, 4>;

/// The pose there; nothing past the point straight above the middle of the shadow.
std::optional<Pose> plain_polished_pose(const Pose& start, const Eigen::Vector3d& middle,
                                        const PolishAngles& angles);

/// The slow twin of ViewPolisher::path: tries every neighbour of every place, again and again.
///
/// @param worth of a pose; 0 if it cannot be.
/// @returns each step's move, 0 to 3 as in `PolishAngles`, and angle.
std::vector<std::pair<int, double>> plain_polish(
    const Pose& start, const Eigen::Vector3d& middle,
    const std::function<std::uint64_t(const Pose&)>& worth);

}  // namespace vantage::test
