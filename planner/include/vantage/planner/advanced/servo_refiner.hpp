#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "vantage/planner/advanced/shadow_view.hpp"
#include "vantage/planner/advanced/view_validity_checker.hpp"
#include "vantage/planner/plan_options.hpp"
#include "vantage/planner/scored_views.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

/// Simulated visual servoing (thesis 7.5): looks at the shadow's bounds on the image, turns towards
/// their middle, backs off when they touch opposite borders, closes in when they are small.
/// Immutable; thread-safe.
class VANTAGE_API ServoRefiner {
 public:
  /// @param camera of the robot; its pose does not matter.
  /// @throws Error as `ServoOptions::check` does.
  ServoRefiner(std::shared_ptr<const ShadowView> view,
               std::shared_ptr<const ViewValidityChecker> validity, const PinholeCamera& camera,
               const Eigen::Vector3d& shadow_centre, const ServoOptions& options);

  /// The candidate itself and the poses after each iteration, all of them feasible. It ends early
  /// where there is no shadow on the image, where the camera stays (to a pixel), and where
  /// every way to go on is forbidden.
  std::vector<ServoStep> path(const Pose& T_world_cam) const;

  /// The same for many candidates that are close to each other, one after the other.
  /// @param extremes where the last look found the shadow's outermost points, if it did; this
  /// path's last look's afterwards. It spares work, and changes no path.
  std::vector<ServoStep> path(const Pose& T_world_cam,
                              std::optional<ExtremePoints>& extremes) const;

 private:
  std::optional<ServoStep> step(const PinholeCamera& camera, const ShadowBounds& bounds) const;

  std::shared_ptr<const ShadowView> view_;
  std::shared_ptr<const ViewValidityChecker> validity_;
  PinholeCamera camera_;
  Eigen::Vector3d shadow_centre_;
  ServoOptions options_;
};

}  // namespace vantage
