#pragma once

#include <Eigen/Core>

#include "vantage/raycore/export.hpp"

namespace vantage {

/// What a journey costs: a view's score counts exp(-weight · distance) times, with the straight
/// distance from where the camera is (H. Gonzalez-Banos and J.-C. Latombe, "Navigation strategies
/// for exploring indoor environments", 2002).
struct TravelCost {
  double weight_per_m = 0;
  Eigen::Vector3d from_m = Eigen::Vector3d::Zero();  ///< where the camera is now

  /// @throws Error bad_input unless all is finite and the weight not negative.
  VANTAGE_API void check() const;
};

}  // namespace vantage
