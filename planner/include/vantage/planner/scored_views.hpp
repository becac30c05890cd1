#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/planner/expected_gain.hpp"
#include "vantage/planner/view_candidates.hpp"
#include "vantage/planner/view_constraints.hpp"
#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

// Results of the candidates of a search, and of the views that a plan chose from them.

/// How a servo iteration moved the camera.
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

/// The four ways in which polishing moves a camera: the first two take it around the shadow's
/// middle, at the same distance and with the middle at the same place on its image.
enum class PolishMove : std::uint8_t {
  around,  ///< about the vertical line through the middle; positive: counterclockwise from above
  over,    ///< up, if positive; never past the point straight above
  pan,     ///< turned on the spot about the image's vertical; positive: to the right
  tilt,    ///< about its horizontal; positive: up
};
VANTAGE_API std::string_view to_text(PolishMove move);

/// One step on the way to a better view.
struct PolishStep {
  PolishMove move = PolishMove::around;
  double by_rad = 0;
  Pose T_world_cam;  ///< after it
};

/// A rejection in words: the check's own, where it has some.
inline std::string_view rejection_text(InvalidReason reason, std::string_view check_says) {
  const bool by_check = reason == InvalidReason::rejected_by_check && !check_says.empty();
  return by_check ? check_says : to_text(reason);
}

/// A candidate and its result.
struct ScoredCandidate {
  ViewCandidate view;
  InvalidReason rejected = InvalidReason::none;
  ScoreBound score = {};        ///< the best of its servo iterations, before travel; at most that
  int servo_iteration = 0;      ///< of the best one; valid if the score is exact
  std::string check_says = {};  ///< what a `ViewCheck` said, if that rejected it

  /// Why it was rejected, in words.
  std::string_view rejection() const { return rejection_text(rejected, check_says); }
};

/// One servo iteration of a candidate.
struct ScoredStep {
  ServoStep step;
  ScoreBound score;
};

/// One of the best candidates.
struct RankedView {
  std::size_t candidate = 0;  ///< index
  Pose T_world_cam;           ///< of its best servo iteration, the first one among equals;
                              ///< after `polish`, where that led
  int servo_iteration = 0;
  Score score = 0;
  Score utility = 0;                                  ///< the score after travel cost
  std::optional<std::uint64_t> revealed_voxels = {};  ///< shadow in sight; set by a plan
  std::optional<GainEstimate> gain = {};              ///< what of it to expect; set by a plan
  std::vector<PolishStep> polish = {};                ///< from the servo iteration on; by a plan
};

}  // namespace vantage
