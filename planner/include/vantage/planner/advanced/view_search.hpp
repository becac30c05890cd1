#pragma once

#include <memory>
#include <span>
#include <vector>

#include "vantage/planner/advanced/servo_refiner.hpp"
#include "vantage/planner/advanced/view_validity_checker.hpp"
#include "vantage/planner/plan_options.hpp"
#include "vantage/planner/scored_views.hpp"
#include "vantage/planner/view_candidates.hpp"
#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

struct SearchResult {
  std::vector<ScoredCandidate> candidates;  ///< in the order given
  std::vector<RankedView> ranked;           ///< the best first; among equals the lower id
  std::size_t finished = 0;                 ///< candidates rejected, scored, surpassed or pruned
  StopReason stopped = StopReason::none;    ///< why, if not all were finished
};

/// Finds the best of many candidates: guaranteed to be the one that scoring each of them in full
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
