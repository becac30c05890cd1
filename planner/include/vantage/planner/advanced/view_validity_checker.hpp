#pragma once

#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/view_constraints.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

/// Tests poses against constraints. Immutable; thread-safe.
///
/// Distances are to the surfaces of `PlanningScene`; what is nearer to a surface than 1e-6 of the
/// scene's coordinates is a matter of rounding.
class VANTAGE_API ViewValidityChecker {
 public:
  /// @throws Error as `ViewConstraints::check` does.
  ViewValidityChecker(const ViewConstraints& constraints, PlanningScene scene,
                      const DepthRange& range);

  InvalidReason check(const Pose& T_world_cam) const;

 private:
  ViewConstraints constraints_;
  PlanningScene scene_;
  DepthRange range_;
};

}  // namespace vantage
