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
  int views = 2;          ///< number of top views to polish; 0: none
  int image_width = 160;  ///< of the images that tries are scored on, at most the camera's

  /// @throws Error bad_input unless 0 <= views <= 1000 and 16 <= image_width <= 16384.
  VANTAGE_API void check() const;
};

/// The cost of travel: a view's score is multiplied by exp(-weight · distance), with the
/// straight-line distance from the camera's position (H. Gonzalez-Banos and J.-C. Latombe,
/// "Navigation strategies for exploring indoor environments", 2002).
struct TravelCost {
  double weight_per_m = 0;
  Eigen::Vector3d from_m = Eigen::Vector3d::Zero();  ///< where the camera is now

  /// @throws Error bad_input unless all is finite and the weight not negative.
  VANTAGE_API void check() const;
};

/// How the best view is searched for (`ViewSearch`).
struct SearchOptions {
  int ranked = 10;  ///< number of exactly ranked top candidates
  std::optional<TravelCost> travel = {};

  /// @throws Error bad_input unless 1 <= ranked, and as `TravelCost::check` does.
  VANTAGE_API void check() const;
};

/// How many views to plan, one after the other, and when to stop.
struct ViewSequenceOptions {
  int most = 1;
  double min_gain_m3 = 0;        ///< planning stops before a further view that would reveal less
  double min_gain_share = 0.01;  ///< the same as a share of all shadow, 0 to 1

  /// @throws Error bad_input unless 1 <= most <= 1000, and for gains that are negative or not
  /// finite, or a share above 1.
  VANTAGE_API void check() const;
};

}  // namespace vantage
