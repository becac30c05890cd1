#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "vantage/planner/advanced/servo_refiner.hpp"
#include "vantage/planner/advanced/travel_cost.hpp"
#include "vantage/planner/advanced/view_polisher.hpp"
#include "vantage/planner/view_candidates.hpp"
#include "vantage/planner/view_constraints.hpp"
#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// How the best view is looked for.
struct SearchOptions {
  int ranked = 10;  ///< so many of the best are found for certain, in their order
  std::optional<TravelCost> travel = {};

  /// @throws Error bad_input unless 1 <= ranked, and as `TravelCost::check` does.
  VANTAGE_API void check() const;
};

/// A candidate and what came of it.
struct ScoredCandidate {
  ViewCandidate view;
  InvalidReason rejected = InvalidReason::none;
  ScoreBound score = {};    ///< the best of its servo iterations, before travel; at most that
  int servo_iteration = 0;  ///< of the best one; of use if the score is exact
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
  Score utility = 0;                                  ///< the score, less what the journey costs
  std::optional<std::uint64_t> revealed_voxels = {};  ///< what the voxel method says; set by a plan
  std::vector<PolishStep> polish = {};                ///< from the servo iteration on; by a plan
};

struct SearchResult {
  std::vector<ScoredCandidate> candidates;  ///< in the order given
  std::vector<RankedView> ranked;           ///< the best first; among equals the lower id
  std::size_t finished = 0;               ///< candidates rejected, scored, surpassed or passed over
  StopReason stopped = StopReason::none;  ///< why, if not all were finished
};

/// Finds the best of many candidates, and certainly the very one that scoring each of them in full
/// would find. Immutable; thread-safe.
class VANTAGE_API ViewSearch {
 public:
  /// @param servo null: candidates are scored as they are.
  ViewSearch(std::shared_ptr<const ViewScorer> scorer,
             std::shared_ptr<const ViewValidityChecker> validity,
             std::shared_ptr<const ServoRefiner> servo, const PinholeCamera& camera,
             const SearchOptions& options);

  /// Runs in the caller's task arena; the result is the same at any number of threads, unless it
  /// was stopped. Candidates that share a position are scored together if they follow each other.
  SearchResult run(std::span<const ViewCandidate> candidates, const StopToken& stop = {}) const;

  /// A candidate's servo iterations, each with its exact score; nothing known where `stop` came
  /// first. Runs in the caller's task arena.
  std::vector<ScoredStep> trace(const ViewCandidate& candidate, const StopToken& stop = {}) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace vantage
