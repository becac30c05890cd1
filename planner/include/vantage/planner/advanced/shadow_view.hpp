#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"

namespace vantage {

/// Where the shadow is on an image: the outermost pixels, inclusive.
struct ShadowBounds {
  int left = 0, right = 0, top = 0, bottom = 0;
  bool operator==(const ShadowBounds&) const = default;
};

/// Points of the shadow, world frame, that the four bounds are from.
using ExtremePoints = std::array<Eigen::Vector3d, 4>;

/// What a look at an image tells.
struct ShadowObservation {
  std::optional<ShadowBounds> bounds = {};  ///< nothing if no pixel shows shadow
  std::optional<Score> score = {};  ///< the view's exact score, where the look tells it, too
  std::optional<ExtremePoints> extremes = {};  ///< where the look knows them
};

/// What a servo sees: an image on which pixels are shadow or not. Immutable and thread-safe.
class VANTAGE_API ShadowView {
 public:
  virtual ~ShadowView() = default;

  /// Nothing if no pixel shows shadow. A pixel is shadow if its ray meets shadow first, at a depth
  /// within the camera's range.
  virtual std::optional<ShadowBounds> shadow_bounds(const PinholeCamera& view) const = 0;

  /// The bounds, and what else the look tells: the score, for methods whose scores are made of the
  /// very image that the servo looks at.
  /// @param expected where a look from close by, if there was one, found the shadow's outermost
  /// points. It may spare work, and changes no bounds.
  virtual ShadowObservation observe(
      const PinholeCamera& view,
      [[maybe_unused]] const std::optional<ExtremePoints>& expected) const {
    return {.bounds = shadow_bounds(view)};
  }
};

}  // namespace vantage
