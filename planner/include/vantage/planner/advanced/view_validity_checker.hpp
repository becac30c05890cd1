#pragma once

#include <string>

#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/view_constraints.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

/// Whether a camera can be at a pose.
struct ViewValidity {
  InvalidReason reason = InvalidReason::none;  ///< none: it can
  std::string check_says = {};                 ///< what a `ViewCheck` said, if that rejected it

  bool valid() const noexcept { return reason == InvalidReason::none; }
};

/// Tests poses against constraints. Immutable; thread-safe, as the constraints' checks must be.
///
/// Distances are to the surfaces of `PlanningScene`; what is nearer to a surface than 1e-6 of the
/// scene's coordinates is a matter of rounding.
class VANTAGE_API ViewValidityChecker {
 public:
  /// @throws Error as `ViewConstraints::check` does.
  ViewValidityChecker(const ViewConstraints& constraints, PlanningScene scene,
                      const DepthRange& range);

  InvalidReason check(const Pose& T_world_cam) const { return examine(T_world_cam).reason; }

  /// The same, with the words of a check.
  ViewValidity examine(const Pose& T_world_cam) const;

 private:
  InvalidReason built_in(const Pose& T_world_cam) const;

  ViewConstraints constraints_;
  PlanningScene scene_;
  DepthRange range_;
};

}  // namespace vantage
