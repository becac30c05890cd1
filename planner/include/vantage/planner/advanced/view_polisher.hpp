#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "vantage/planner/advanced/view_validity_checker.hpp"
#include "vantage/planner/plan_options.hpp"
#include "vantage/planner/scored_views.hpp"
#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// Looks for a better view around a good one: a compass search (R. Hooke and T. Jeeves, "Direct
/// search solution of numerical and statistical problems", 1961). What a search over few candidates
/// misses lies between them: the servo turns a camera and moves it along its axis, but never around
/// what hides the shadow.
///
/// The distance from the shadow stays as it is. To choose that is the servo's part (thesis 7.5): a
/// score that grows with depth, as D^6 does, would be the better the farther away, without end.
/// Immutable; thread-safe.
class VANTAGE_API ViewPolisher {
 public:
  /// @param camera of the robot; its pose does not matter.
  /// @throws Error as the options' checks do.
  ViewPolisher(std::shared_ptr<const ViewScorer> scorer,
               std::shared_ptr<const ViewValidityChecker> validity, const PinholeCamera& camera,
               const Eigen::Vector3d& shadow_centre, const PolishOptions& options,
               const std::optional<TravelCost>& travel = {});

  /// Steps to ever better views, all of them feasible: first of 20° around and over and of 6° in
  /// pan and tilt, then of a half and of a quarter of that, each as long as one of them helps. None
  /// if there is nothing better around. It ends early if `stop` asks for it.
  ///
  /// Better is a higher score after travel cost, on an image of `image_width`: on a larger one the
  /// last of them may differ a little.
  std::vector<PolishStep> path(const Pose& T_world_cam, const StopToken& stop = {}) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace vantage
