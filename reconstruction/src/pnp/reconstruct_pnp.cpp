#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include "hypothesis/candidate_object.hpp"
#include "pnp/instances.hpp"

namespace vantage {
namespace reconstruction::detail {
namespace {

/// Labels have no pixels that a pose could be fitted to.
void leave_out_labels(CollectedMeasurements& collected) {
  std::vector<Measurement> rest;
  for (Measurement& measurement : collected.measurements) {
    if (measurement.label()) {
      collected.unexplained.push_back(
          {measurement.id, "a label alone does not determine a pose; the voting method uses it"});
    } else {
      rest.push_back(std::move(measurement));
    }
  }
  collected.measurements = std::move(rest);
}

/// Without the measurements of these numbers.
PoseHypothesis without(const PoseHypothesis& voted, const std::set<std::size_t>& numbers) {
  PoseHypothesis rest{voted.T_world_object, {}, {}, {}};
  for (std::size_t i = 0; i < voted.correspondences.size(); ++i) {
    if (numbers.contains(voted.correspondences[i]->number)) continue;
    rest.correspondences.push_back(voted.correspondences[i]);
    rest.each.push_back(voted.each[i]);
    rest.sum.add(voted.each[i]);
  }
  return rest;
}

/// What the best way does not explain after all, with its final pose.
std::set<std::size_t> missed(const Candidate& candidate, const InlierThresholds& thresholds) {
  const PoseHypothesis& best =
      std::min_element(candidate.voted_hypotheses.begin(), candidate.voted_hypotheses.end(),
                       [](const auto& a, const auto& b) { return a.chi_square < b.chi_square; })
          ->hypothesis;
  std::set<std::size_t> numbers;
  for (const Correspondence* correspondence : best.correspondences) {
    const LinearSystem e =
        linear_system_of(*correspondence, best.T_world_object, thresholds.min_sigma_px());
    if (!thresholds.explains(*correspondence, e)) numbers.insert(correspondence->number);
  }
  return numbers;
}

/// Fits every way; measurements that the best one then misses are taken out of all of them. Nothing
/// if too little is left.
std::optional<Candidate> fitted(Instance instance, const InlierThresholds& thresholds) {
  while (true) {
    Candidate candidate;
    for (const PoseHypothesis& voted : instance) {
      if (voted.sum.points < kMinPoints) return std::nullopt;
      candidate.voted_hypotheses.push_back(generalized_least_squares(voted));
    }
    const std::set<std::size_t> numbers = missed(candidate, thresholds);
    if (numbers.empty()) return candidate;
    for (PoseHypothesis& voted : instance) voted = without(voted, numbers);
  }
}

/// The objects of all components, in the order of these; `done` says which were looked at before
/// `stop` ended it.
std::vector<Candidate> find_all(const std::vector<Component>& components,
                                const InlierThresholds& thresholds, const StopToken& stop,
                                std::vector<char>& done) {
  std::vector<std::vector<Candidate>> found(components.size());
  done.assign(components.size(), 0);
  stop.expect(components.size());
  tbb::parallel_for(std::size_t(0), components.size(), [&](std::size_t c) {
    if (stop.stop_requested()) return;
    for (Instance& instance : find_instances(components[c], thresholds)) {
      auto candidate = fitted(std::move(instance), thresholds);
      if (candidate) found[c].push_back(std::move(*candidate));
    }
    done[c] = 1;
    stop.advance(1);
  });
  std::vector<Candidate> all;
  for (auto& some : found) {
    std::move(some.begin(), some.end(), std::back_inserter(all));
  }
  return all;
}

void reject_ambiguous(std::vector<Candidate>& candidates) {
  for (Candidate& candidate : candidates) {
    if (!candidate.rejected.empty() || candidate.best().correspondences.size() > 1) continue;
    if (candidate.voted_hypotheses.size() < 2) continue;
    candidate.rejected =
        fmt::format("one feature in one view allows {} poses", candidate.voted_hypotheses.size());
  }
}

/// Why a measurement is part of nothing.
std::string reason_for(const Component& component, std::size_t number,
                       const InlierThresholds& thresholds) {
  int most = 0;
  for (const Correspondence& correspondence : component.correspondences) {
    if (correspondence.number != number) continue;
    most = std::max(most,
                    correspondence.measurement->pose() ? 4 : int(correspondence.points_m.size()));
  }
  if (most < kMinPoints) {
    return "too few points for a pose of their own, and no object that they belong to";
  }
  return fmt::format(
      "no pose of its object explains it within {:g} px: its points do not fit, are "
      "collinear, or belong to something else",
      thresholds.inlier_px);
}

void explain_rest(const std::vector<Component>& components, const std::vector<char>& done,
                  const InlierThresholds& thresholds, Reconstruction& result) {
  std::set<ObservationId> known;
  for (const auto& object : result.objects) {
    for (const Support& support : object.support) known.insert(support.id);
  }
  for (const Unexplained& unexplained : result.unexplained) known.insert(unexplained.id);
  for (std::size_t c = 0; c < components.size(); ++c) {
    for (std::size_t n = 0; n < components[c].measurements.size(); ++n) {
      const ObservationId id = components[c].measurements[n]->id;
      if (known.contains(id)) continue;
      result.unexplained.push_back({id, done[c] ? reason_for(components[c], n, thresholds)
                                                : "not processed: stopped before"});
    }
  }
}

}  // namespace
}  // namespace reconstruction::detail

Reconstruction reconstruct_pnp(std::span<const CameraView> views, const KnowledgeBase& knowledge,
                               const ReconstructOptions& options, const StopToken& stop) {
  using namespace reconstruction::detail;
  CollectedMeasurements collected = collect_measurements(views, knowledge, options);
  leave_out_labels(collected);
  const InlierThresholds thresholds{options.inlier_px};
  const std::vector<Component> components = split_into_components(collected.measurements);
  std::vector<char> done;
  std::vector<Candidate> candidates = find_all(components, thresholds, stop, done);
  reject_misidentified(candidates, thresholds);
  verify_hypotheses(candidates, views, options);
  if (!options.keep_ambiguous) reject_ambiguous(candidates);

  Reconstruction result{{}, std::move(collected.unexplained), StopReason::none};
  if (std::count(done.begin(), done.end(), 0) > 0) result.stopped = stop.reason();
  for (const Candidate& candidate : candidates) {
    if (candidate.rejected.empty()) {
      result.objects.push_back(object_of(candidate));
      continue;
    }
    for (const Correspondence* correspondence : candidate.best().correspondences) {
      result.unexplained.push_back({correspondence->measurement->id, candidate.rejected});
    }
    result.rejected.push_back({object_of(candidate), candidate.rejected});
  }
  explain_rest(components, done, thresholds, result);
  sort_result(knowledge, result);
  return result;
}

}  // namespace vantage
