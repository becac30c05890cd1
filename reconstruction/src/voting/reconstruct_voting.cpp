#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "hypothesis/candidate_object.hpp"
#include "voting/greedy_selection.hpp"

namespace vantage {
namespace detail {
namespace {

VoteGrid grid_for(const ReconstructOptions& options) {
  VoteGrid grid;
  grid.cell_m = 2 * options.merge_m;
  return grid;
}

/// Labels are for the best way.
ReconstructedObject object_of(const Elected& elected, const Ballot& ballot) {
  ReconstructedObject object = object_of(elected.candidate);
  for (const auto& [sighting, feature] : elected.verdicts.front().labels) {
    object.support.push_back({ballot.sightings[sighting].id, feature, 0});
  }
  return object;
}

/// Whether the object may also be of the same type at another pose.
bool is_ambiguous(const Candidate& candidate) {
  return std::any_of(candidate.ways.begin() + 1, candidate.ways.end(), [&](const FinalFit& way) {
    return way.explanation.type() == candidate.best().type();
  });
}

/// What is not seen speaks too: see plausibility.hpp.
void judge(std::vector<Elected>& all, std::span<const CameraView> views,
           const ReconstructOptions& options) {
  std::vector<Candidate> judged;
  for (const Elected& elected : all) judged.push_back(elected.candidate);
  reject_misread(judged, {options.inlier_px});
  weigh(judged, views, options);
  for (std::size_t i = 0; i < all.size(); ++i) {
    Candidate& candidate = all[i].candidate;
    candidate.there *= judged[i].there;
    candidate.rejected = judged[i].rejected;
    if (candidate.rejected.empty() && !options.keep_ambiguous && is_ambiguous(candidate)) {
      candidate.rejected = fmt::format("its {} may be tilted {} ways",
                                       candidate.best().type()->name, candidate.ways.size());
    }
  }
}

/// Everything that is not in an object, with its reason.
void explain_rest(const Ballot& ballot, const Election& election, Reconstruction& result) {
  std::set<ObservationId> known;
  for (const auto& object : result.objects) {
    for (const Support& support : object.support) known.insert(support.id);
  }
  for (const Unexplained& unexplained : result.unexplained) known.insert(unexplained.id);
  for (std::size_t i = 0; i < ballot.sightings.size(); ++i) {
    const ObservationId id = ballot.sightings[i].id;
    if (known.contains(id)) continue;
    result.unexplained.push_back({id, result.stopped == StopReason::none
                                          ? election.reason_against(i)
                                          : "not looked at: stopped before"});
  }
}

}  // namespace
}  // namespace detail

Reconstruction reconstruct_voting(std::span<const CameraView> views, const KnowledgeBase& knowledge,
                                  const ReconstructOptions& options, const StopToken& stop) {
  using namespace detail;
  Gathered gathered = gather(views, knowledge, options);
  Reconstruction result;
  result.unexplained = std::move(gathered.unexplained);
  const Ballot ballot = ballot_of(gathered.sightings);
  Election election(ballot, options, grid_for(options));
  std::vector<Elected> all;
  while ((result.stopped = stop.reason()) == StopReason::none) {
    auto elected = election.next();
    if (!elected) break;
    all.push_back(std::move(*elected));
  }
  judge(all, views, options);
  for (const Elected& elected : all) {
    const ReconstructedObject object = object_of(elected, ballot);
    if (elected.candidate.rejected.empty()) {
      result.objects.push_back(object);
      continue;
    }
    for (const Support& support : object.support) {
      result.unexplained.push_back({support.id, elected.candidate.rejected});
    }
  }
  explain_rest(ballot, election, result);
  sort_result(knowledge, result);
  return result;
}

}  // namespace vantage
