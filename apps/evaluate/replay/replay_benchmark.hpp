#pragma once

#include <cstdint>
#include <vector>

#include "evaluate/planning/planning_benchmark.hpp"
#include "metrics/planning/replay_evaluation.hpp"
#include "plan/plan_input.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// What `vantage evaluate replay` was asked for.
struct ReplayBenchmarkOptions {
  std::vector<NamedMethod> methods;
  std::size_t pairs = 20;
  std::uint64_t seed = 0;
  double min_seen = 0.1;  ///< a frame of a pair shows at least this share of the work area
};

/// Plans from pairs of a recording's frames, with the others as candidates, and folds every other
/// frame's depth image in to see what it really reveals.
///
/// A candidate is the camera that took the frame, where it was then: nothing is rejected, because
/// all recorded poses were possible, and the servo moves nothing. A method's pick is the candidate
/// with the highest score, among equals the first. Real gain is the shadow of the two frames that
/// is no longer shadow in a classification of all three.
///
/// Runs in the caller's task arena; the result is the same at any number of threads. If `stop`
/// asked to stop, it has the pairs that were finished.
/// @param input its world's cameras are the frames; of its request the work area, the voxel size
/// and the volume options count.
/// @throws Error bad_input for a frame without depth, fewer than three frames, and fewer than two
/// that show enough of the work area; as `classify` and `make_view_scorer` do.
ReplayEvaluation evaluate_replay(const PlanInput& input, const ReplayBenchmarkOptions& settings,
                                 const StopToken& stop = {});

}  // namespace vantage
