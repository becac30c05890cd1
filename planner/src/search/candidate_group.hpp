#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scene/utility.hpp"
#include "search/top_k.hpp"
#include "vantage/planner/advanced/view_search.hpp"

namespace vantage::planner::detail {

/// What searching looks at and asks.
struct SearchTools {
  std::shared_ptr<const ViewScorer> scorer;
  std::shared_ptr<const ViewValidityChecker> validity;
  std::shared_ptr<const ServoRefiner> servo;  ///< null: none
  PinholeCamera camera;
  Utility utility;

  /// @param outermost as of `ServoRefiner::path`.
  std::vector<ServoStep> path(const Pose& T_world_cam,
                              std::optional<ExtremePoints>& extremes) const {
    if (servo == nullptr) return {{T_world_cam, ServoMove::start}};
    return servo->path(T_world_cam, extremes);
  }
};

/// Candidates that follow each other and share a position: [first, last) of the list.
struct GroupRange {
  std::size_t first = 0, last = 0;
};
std::vector<GroupRange> sites_of(std::span<const ViewCandidate> candidates);

/// All groups, evenly golden_ratio_order over the list: one step is about the golden ratio of it.
std::vector<GroupRange> golden_ratio_order(const std::vector<GroupRange>& camera_groups);

/// How many candidates were rejected, scored, surpassed or pruned.
std::size_t finished(std::span<const ScoredCandidate> candidates);

/// The work on one group: first `prepare`, which finds where the camera could go and bounds what
/// that would be worth, then, if the bound is good enough, `score`. One thread at a time.
class CandidateGroup {
 public:
  CandidateGroup(const SearchTools& context, std::span<const ViewCandidate> candidates,
                 GroupRange range)
      : context_(&context), candidates_(candidates), range_(range) {}

  /// @param ranking as of `score`: what certainly is not among the best is bounded less closely.
  void prepare(const TopK& top, const StopToken& stop);

  /// The best utility that any of its candidates may have.
  Score bound() const { return bound_; }
  std::size_t first() const { return range_.first; }
  std::size_t size() const { return range_.last - range_.first; }
  bool matters(const TopK& top) const;

  /// Scores what may be among the best.
  /// @param ranking as it was before; must not change meanwhile.
  void score(const TopK& top, const StopToken& stop);

  /// The result of each candidate, and those among the best.
  void report(std::span<ScoredCandidate> results, TopK& top) const;

 private:
  /// One view that a candidate may end at.
  struct Step {
    std::size_t candidate = 0;  ///< in the group
    int iteration = 0;
    PinholeCamera view;
    std::uint64_t share = 0;  ///< its score after travel cost
    ScoreBound score;         ///< first the upper bound

    Score utility() const { return Utility::of(score.score, share); }
  };
  struct Outcome {
    bool ready = false;
    ViewValidity validity = {};
  };

  void score_group(std::span<Step* const> group, const TopK& top, const StopToken& stop);
  Score needed(const Step& step, const TopK& top) const;
  const Step* best_exact(std::size_t candidate) const;
  ScoredCandidate outcome(std::size_t candidate) const;

  const SearchTools* context_;
  std::span<const ViewCandidate> candidates_;
  GroupRange range_;
  std::vector<Outcome> outcomes_;
  std::vector<Step> steps_;
  Score bound_ = 0;
};

}  // namespace vantage::planner::detail
