#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "hypothesis/candidate_object.hpp"
#include "voting/greedy_selection.hpp"

namespace vantage {
namespace reconstruction::detail {
namespace {

VoteGrid grid_for(const ReconstructOptions& options) {
  VoteGrid grid;
  grid.cell_m = 2 * options.merge_m;
  return grid;
}

/// Labels are for the best way.
ReconstructedObject object_of(const SelectedHypothesis& selected,
                              const CandidateCorrespondences& candidates) {
  ReconstructedObject object = object_of(selected.candidate);
  for (const auto& [measurement, feature] : selected.verdicts.front().labels) {
    object.support.push_back({candidates.measurements[measurement].id, feature, 0});
  }
  return object;
}

/// Whether the object may also be of the same type at another pose.
bool is_ambiguous(const Candidate& candidate) {
  return std::any_of(
      candidate.voted_hypotheses.begin() + 1, candidate.voted_hypotheses.end(),
      [&](const FinalFit& voted) { return voted.hypothesis.type() == candidate.best().type(); });
}

/// What is not seen counts as well: see hypothesis_verification.hpp.
void judge(std::vector<SelectedHypothesis>& all, std::span<const CameraView> views,
           const ReconstructOptions& options) {
  std::vector<Candidate> judged;
  for (const SelectedHypothesis& selected : all) judged.push_back(selected.candidate);
  reject_misidentified(judged, {options.inlier_px});
  verify_hypotheses(judged, views, options);
  for (std::size_t i = 0; i < all.size(); ++i) {
    Candidate& candidate = all[i].candidate;
    candidate.there *= judged[i].there;
    candidate.rejected = judged[i].rejected;
    if (candidate.rejected.empty() && !options.keep_ambiguous && is_ambiguous(candidate)) {
      candidate.rejected =
          fmt::format("its {} may be tilted {} ways", candidate.best().type()->name,
                      candidate.voted_hypotheses.size());
    }
  }
}

/// Everything that is not in an object, with its reason.
void explain_rest(const CandidateCorrespondences& candidates,
                  const GreedyHypothesisSelection& election, Reconstruction& result) {
  std::set<ObservationId> known;
  for (const auto& object : result.objects) {
    for (const Support& support : object.support) known.insert(support.id);
  }
  for (const Unexplained& unexplained : result.unexplained) known.insert(unexplained.id);
  for (std::size_t i = 0; i < candidates.measurements.size(); ++i) {
    const ObservationId id = candidates.measurements[i].id;
    if (known.contains(id)) continue;
    result.unexplained.push_back({id, result.stopped == StopReason::none
                                          ? election.reason_against(i)
                                          : "not processed: stopped before"});
  }
}

}  // namespace
}  // namespace reconstruction::detail

Reconstruction reconstruct_voting(std::span<const CameraView> views, const KnowledgeBase& knowledge,
                                  const ReconstructOptions& options, const StopToken& stop) {
  using namespace reconstruction::detail;
  CollectedMeasurements collected = collect_measurements(views, knowledge, options);
  Reconstruction result;
  result.unexplained = std::move(collected.unexplained);
  const CandidateCorrespondences candidates = candidate_correspondences(collected.measurements);
  GreedyHypothesisSelection election(candidates, options, grid_for(options));
  std::vector<SelectedHypothesis> all;
  while ((result.stopped = stop.reason()) == StopReason::none) {
    auto selected = election.next();
    if (!selected) break;
    all.push_back(std::move(*selected));
  }
  judge(all, views, options);
  for (const SelectedHypothesis& selected : all) {
    const ReconstructedObject object = object_of(selected, candidates);
    if (selected.candidate.rejected.empty()) {
      result.objects.push_back(object);
      continue;
    }
    for (const Support& support : object.support) {
      result.unexplained.push_back({support.id, selected.candidate.rejected});
    }
    result.rejected.push_back({object, selected.candidate.rejected});
  }
  explain_rest(candidates, election, result);
  sort_result(knowledge, result);
  return result;
}

}  // namespace vantage
