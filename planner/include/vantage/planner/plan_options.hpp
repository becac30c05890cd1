#pragma once

#include <Eigen/Core>
#include <optional>

#include "vantage/raycore/export.hpp"

namespace vantage {

/// How simulated visual servoing moves the camera (thesis 7.5; `ServoRefiner`).
struct ServoOptions {
  int iterations = 5;     ///< 0: candidates are scored as they are
  int image_width = 160;  ///< of the images that it looks at; their height follows

  /// @throws Error bad_input unless 0 <= iterations <= 100 and 16 <= image_width <= 16384.
  VANTAGE_API void check() const;
};

/// Which views are polished after a search, and how (`ViewPolisher`).
struct PolishOptions {
  int views = 2;          ///< so many of the best; 0: none
  int image_width = 160;  ///< of the images that tries are scored on, at most the camera's

  /// @throws Error bad_input unless 0 <= views <= 1000 and 16 <= image_width <= 16384.
  VANTAGE_API void check() const;
};

/// What a journey costs: a view's score counts exp(-weight · distance) times, with the straight
/// distance from where the camera is (H. Gonzalez-Banos and J.-C. Latombe, "Navigation strategies
/// for exploring indoor environments", 2002).
struct TravelCost {
  double weight_per_m = 0;
  Eigen::Vector3d from_m = Eigen::Vector3d::Zero();  ///< where the camera is now

  /// @throws Error bad_input unless all is finite and the weight not negative.
  VANTAGE_API void check() const;
};

/// How the best view is looked for (`ViewSearch`).
struct SearchOptions {
  int ranked = 10;  ///< so many of the best are found for certain, in their order
  std::optional<TravelCost> travel = {};

  /// @throws Error bad_input unless 1 <= ranked, and as `TravelCost::check` does.
  VANTAGE_API void check() const;
};

/// How many views are to be planned, one after the other, and when it is enough.
struct ViewSequenceOptions {
  int most = 1;
  double min_gain_m3 = 0;        ///< a further view that is to reveal less is not worth it
  double min_gain_share = 0.01;  ///< the same as a share of all shadow, 0 to 1

  /// @throws Error bad_input unless 1 <= most <= 1000, and for gains that are negative or not
  /// finite, or a share above 1.
  VANTAGE_API void check() const;
};

}  // namespace vantage
