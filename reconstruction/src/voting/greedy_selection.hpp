#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hypothesis/hypothesis_verification.hpp"
#include "voting/hough_accumulator.hpp"
#include "voting/label_evidence.hpp"

namespace vantage::detail {

/// One way to explain sightings, with all that is for and against it.
struct Way {
  Explanation explanation;
  Verdict verdict;

  /// Votes for it, less those against it.
  double net() const {
    return double(explanation.readings.size()) + double(verdict.labels.size()) -
           double(verdict.against);
  }
};

/// An object: every way to explain its sightings, the likeliest first, and what is said of that.
struct Elected {
  Candidate candidate;
  std::vector<Verdict> verdicts;  ///< of each way
  double net = 0;                 ///< votes for the best way, less those against it
};

/// How many sightings both explain.
std::size_t common(const Explanation& a, const Explanation& b);

/// Shares are normalised votes, times the likelihoods of what was measured: exp(-χ²/2), χ² over its
/// ratio to the degrees of freedom where that is above 1; a sighting that only one of two explains
/// is a wrong id (one in twenty) for the other. What is against the best way makes it doubtful
/// altogether. Ways that fit worse by more than `least_evidence` are left out, and so are those
/// with no more votes for than against them (unless it is a tie for all), and those that do not
/// explain all that the best one does. Nothing if none is left.
std::optional<Elected> weighed(std::vector<Way> ways, double least_evidence);

/// Takes objects out of the table of votes, the one with most votes first; what it explains has no
/// other votes from then on. Not thread-safe.
class Election {
 public:
  Election(const Ballot& ballot, const ReconstructOptions& options, const VoteGrid& grid = {});

  /// The next object; none if no vote is left.
  std::optional<Elected> next();

  /// Why a sighting is of no object that was taken out; to be asked in the end.
  std::string reason_against(std::size_t sighting) const;

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
  std::optional<Elected> elected_around(const Entry& entry);
  void put_back(const Entry& entry);
  bool defer(const Entry& entry, double net);
  std::optional<Way> way_from(std::size_t vote);
  std::optional<Explanation> grown(const std::optional<Explanation>& start) const;
  std::vector<const Reading*> pool(const ObjectType& type, const Pose& T_world_object) const;
  std::vector<Way> ways(Way first);
  bool worth_trying(std::size_t vote, const std::vector<std::size_t>& sightings,
                    const std::vector<Way>& ways) const;
  void drop(std::size_t vote, const std::string& reason);
  void drop_votes_for(const Explanation& explanation, const std::string& reason);
  bool taken(const Explanation& explanation) const;
  void accept(const Elected& elected);

  const Ballot* ballot_;
  ReconstructOptions options_;
  Bounds bounds_;
  std::unique_ptr<Witnesses> witnesses_;
  std::unique_ptr<Poll> poll_;
  std::vector<double> said_;    // of each vote: labels for it, less what is against it
  std::vector<bool> deferred_;  // of each vote: by what it explains, not by its height
  std::vector<Entry> queue_;    // a heap
  std::vector<bool> free_;      // of each sighting: no object has it
  std::vector<std::string> reasons_;
  std::map<const ObjectType*, std::vector<const Reading*>> readings_of_;  // never walked
  std::vector<std::pair<const ObjectType*, Pose>> objects_;
};

}  // namespace vantage::detail
