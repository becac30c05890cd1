#pragma once

#include <span>
#include <vector>

#include "metrics/bop/true_object.hpp"
#include "vantage/reconstruction/observation.hpp"

namespace vantage {

/// For each view, which of the true objects it sees: by a feature that has the object's key and,
/// for points, lies within `tolerance_px` of where the object truly has it; for poses and labels,
/// within `tolerance_m`. A view without a pose sees nothing.
std::vector<std::vector<bool>> seen_objects(std::span<const CameraView> views,
                                            std::span<const TrueObject> truth,
                                            double tolerance_px = 5, double tolerance_m = 0.02);

/// What any of these views sees.
std::vector<bool> seen_by(std::span<const std::vector<bool>> seen,
                          std::span<const std::size_t> views);

}  // namespace vantage
