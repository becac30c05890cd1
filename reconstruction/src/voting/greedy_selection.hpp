#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hypothesis/hypothesis_verification.hpp"
#include "voting/hough_accumulator.hpp"
#include "voting/label_evidence.hpp"

namespace vantage::reconstruction::detail {

/// One way to explain measurements, with all that is for and against it.
struct VotedHypothesis {
  PoseHypothesis hypothesis;
  LabelVotes label_votes;

  /// Votes for it, less those against it.
  double net() const {
    return double(hypothesis.correspondences.size()) + double(label_votes.labels.size()) -
           double(label_votes.against);
  }
};

/// An object: every way to explain its measurements, the likeliest first, and what is said of that.
struct SelectedHypothesis {
  Candidate candidate;
  std::vector<LabelVotes> verdicts;  ///< of each way
  double net = 0;                    ///< votes for the best way, less those against it
};

/// How many measurements both explain.
std::size_t common(const PoseHypothesis& a, const PoseHypothesis& b);

/// Shares are normalised votes, times the likelihoods of what was measured: exp(-χ²/2), χ² over its
/// ratio to the degrees of freedom where that is above 1; a measurement that only one of two
/// explains is a wrong id (one in twenty) for the other. What is against the best way makes it
/// doubtful altogether. Ways that fit worse by more than `min_evidence` are left out, and so are
/// those with no more votes for than against them (unless it is a tie for all), and those that do
/// not explain all that the best one does. Nothing if none is left.
std::optional<SelectedHypothesis> weigh_hypotheses(std::vector<VotedHypothesis> voted_hypotheses,
                                                   double min_evidence);

/// Takes objects out of the table of votes, the one with most votes first; what it explains has no
/// other votes from then on. Not thread-safe.
class GreedyHypothesisSelection {
 public:
  GreedyHypothesisSelection(const CandidateCorrespondences& candidates,
                            const ReconstructOptions& options, const VoteGrid& grid = {});

  /// The next object; none if no vote is left.
  std::optional<SelectedHypothesis> next();

  /// Why a measurement is of no object that was taken out; to be asked in the end.
  std::string reason_against(std::size_t measurement) const;

 private:
  struct Entry {
    double height = 0;
    std::size_t vote = 0;
    bool operator<(const Entry& other) const {  // the highest on top, of equals the first
      return height != other.height ? height < other.height : vote > other.vote;
    }
  };

  double height(std::size_t vote) const;
  void rank_votes();
  std::optional<SelectedHypothesis> selected_around(const Entry& entry);
  void put_back(const Entry& entry);
  bool defer(const Entry& entry, double net);
  std::optional<VotedHypothesis> hypothesis_from(std::size_t vote);
  std::optional<PoseHypothesis> expanded(const std::optional<PoseHypothesis>& start) const;
  std::vector<const Correspondence*> pool(const ObjectType& type, const Pose& T_world_object) const;
  std::vector<VotedHypothesis> voted_hypotheses(VotedHypothesis first);
  bool worth_trying(std::size_t vote, const std::vector<std::size_t>& measurements,
                    const std::vector<VotedHypothesis>& voted_hypotheses) const;
  void drop(std::size_t vote, const std::string& reason);
  void drop_votes_for(const PoseHypothesis& hypothesis, const std::string& reason);
  bool taken(const PoseHypothesis& hypothesis) const;
  void accept(const SelectedHypothesis& selected);

  const CandidateCorrespondences* candidates_;
  ReconstructOptions options_;
  InlierThresholds thresholds_;
  std::unique_ptr<LabelEvidence> label_evidence_;
  std::unique_ptr<HoughAccumulator> accumulator_;
  std::vector<double> label_score_;  // of each vote: labels for it, less what is against it
  std::vector<bool> deferred_;       // of each vote: by what it explains, not by its height
  std::vector<Entry> queue_;         // a heap
  std::vector<bool> free_;           // of each measurement: no object has it
  std::vector<std::string> reasons_;
  std::map<const ObjectType*, std::vector<const Correspondence*>>
      correspondences_of_;  // never walked
  std::vector<std::pair<const ObjectType*, Pose>> objects_;
};

}  // namespace vantage::reconstruction::detail
