#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "vantage/planner/advanced/shadow_view.hpp"
#include "vantage/planner/view_constraints.hpp"
#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

/// How the servo moves the camera.
struct ServoOptions {
  int iterations = 5;
  int image_width = 160;  ///< of the images that it looks at; their height follows

  /// @throws Error bad_input unless 0 <= iterations <= 100 and 16 <= image_width <= 16384.
  VANTAGE_API void check() const;
};

/// What came of one iteration.
enum class ServoMove : std::uint8_t {
  start,   ///< the candidate itself
  aim,     ///< turned towards the middle of the shadow
  back,    ///< and moved back, because the shadow touched opposite borders
  closer,  ///< and moved closer, because the shadow was small
  polish,  ///< none of the servo's: where a `ViewPolisher` led from the best iteration
};
VANTAGE_API std::string_view to_text(ServoMove move);

struct ServoStep {
  Pose T_world_cam;
  ServoMove move = ServoMove::start;
  std::optional<Score> score = {};  ///< exact, where the servo's look told it
};

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
