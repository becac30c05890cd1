#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "vantage/planner/view_constraints.hpp"
#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/api.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

/// Where the shadow is on an image: the outermost pixels, inclusive.
struct ShadowBounds {
  int left = 0, right = 0, top = 0, bottom = 0;
  bool operator==(const ShadowBounds&) const = default;
};

/// Points of the shadow, world frame, that the four bounds are from.
using OutermostShadow = std::array<Eigen::Vector3d, 4>;

/// What a look at an image tells.
struct ShadowSight {
  std::optional<ShadowBounds> bounds = {};  ///< nothing if no pixel shows shadow
  std::optional<Score> score = {};  ///< the view's exact score, where the look tells it, too
  std::optional<OutermostShadow> outermost = {};  ///< where the look knows them
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
  virtual ShadowSight look(const PinholeCamera& view,
                           const std::optional<OutermostShadow>& /*expected*/) const {
    return {.bounds = shadow_bounds(view)};
  }
};

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
  ServoRefiner(std::shared_ptr<const ShadowView> view, std::shared_ptr<const ViewChecker> checker,
               const PinholeCamera& camera, const Eigen::Vector3d& shadow_centre,
               const ServoOptions& options);

  /// The candidate itself and the poses after each iteration, all of them feasible. It ends early
  /// where there is no shadow on the image, where the camera stays (to a pixel), and where
  /// every way to go on is forbidden.
  std::vector<ServoStep> path(const Pose& T_world_cam) const;

  /// The same for many candidates that are close to each other, one after the other.
  /// @param outermost where the last look found the shadow's outermost points, if it did; this
  /// path's last look's afterwards. It spares work, and changes no path.
  std::vector<ServoStep> path(const Pose& T_world_cam,
                              std::optional<OutermostShadow>& outermost) const;

 private:
  std::optional<ServoStep> step(const PinholeCamera& camera, const ShadowBounds& bounds) const;

  std::shared_ptr<const ShadowView> view_;
  std::shared_ptr<const ViewChecker> checker_;
  PinholeCamera camera_;
  Eigen::Vector3d shadow_centre_;
  ServoOptions options_;
};

}  // namespace vantage
