#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include "hypothesis/candidate_object.hpp"
#include "pnp/instances.hpp"

namespace vantage {
namespace detail {
namespace {

/// Labels have no pixels that a pose could be fitted to.
void leave_out_labels(Gathered& gathered) {
  std::vector<Sighting> rest;
  for (Sighting& sighting : gathered.sightings) {
    if (sighting.label()) {
      gathered.unexplained.push_back(
          {sighting.id, "a label says too little for a pose; the voting method uses it"});
    } else {
      rest.push_back(std::move(sighting));
    }
  }
  gathered.sightings = std::move(rest);
}

/// Without the sightings of these numbers.
Explanation without(const Explanation& way, const std::set<std::size_t>& numbers) {
  Explanation rest{way.T_world_object, {}, {}, {}};
  for (std::size_t i = 0; i < way.readings.size(); ++i) {
    if (numbers.contains(way.readings[i]->number)) continue;
    rest.readings.push_back(way.readings[i]);
    rest.each.push_back(way.each[i]);
    rest.sum.add(way.each[i]);
  }
  return rest;
}

/// What the best way does not explain after all, with its final pose.
std::set<std::size_t> missed(const Candidate& candidate, const Bounds& bounds) {
  const Explanation& best =
      std::min_element(candidate.ways.begin(), candidate.ways.end(),
                       [](const auto& a, const auto& b) { return a.chi_square < b.chi_square; })
          ->explanation;
  std::set<std::size_t> numbers;
  for (const Reading* reading : best.readings) {
    const Evidence e = evidence_of(*reading, best.T_world_object, bounds.least_sigma_px());
    if (!bounds.explains(*reading, e)) numbers.insert(reading->number);
  }
  return numbers;
}

/// Fits every way; sightings that the best one then misses are taken out of all of them. Nothing if
/// too little is left.
std::optional<Candidate> fitted(Instance instance, const Bounds& bounds) {
  while (true) {
    Candidate candidate;
    for (const Explanation& way : instance) {
      if (way.sum.points < kFewestPoints) return std::nullopt;
      candidate.ways.push_back(fit_finally(way));
    }
    const std::set<std::size_t> numbers = missed(candidate, bounds);
    if (numbers.empty()) return candidate;
    for (Explanation& way : instance) way = without(way, numbers);
  }
}

/// The objects of all components, in the order of these; `done` says which were looked at before
/// `stop` ended it.
std::vector<Candidate> find_all(const std::vector<Component>& components, const Bounds& bounds,
                                const StopToken& stop, std::vector<char>& done) {
  std::vector<std::vector<Candidate>> found(components.size());
  done.assign(components.size(), 0);
  stop.expect(components.size());
  tbb::parallel_for(std::size_t(0), components.size(), [&](std::size_t c) {
    if (stop.stop_requested()) return;
    for (Instance& instance : find_instances(components[c], bounds)) {
      auto candidate = fitted(std::move(instance), bounds);
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
    if (!candidate.rejected.empty() || candidate.best().readings.size() > 1) continue;
    if (candidate.ways.size() < 2) continue;
    candidate.rejected =
        fmt::format("one feature in one view leaves {} poses open", candidate.ways.size());
  }
}

/// Why a sighting is part of nothing.
std::string reason_for(const Component& component, std::size_t number, const Bounds& bounds) {
  int most = 0;
  for (const Reading& reading : component.readings) {
    if (reading.number != number) continue;
    most = std::max(most, reading.sighting->pose() ? 4 : int(reading.points_m.size()));
  }
  if (most < kFewestPoints) {
    return "too few points for a pose of their own, and no object that they belong to";
  }
  return fmt::format(
      "no pose of its object explains it within {:g} px: its points do not fit, are "
      "collinear, or belong to something else",
      bounds.inlier_px);
}

void explain_rest(const std::vector<Component>& components, const std::vector<char>& done,
                  const Bounds& bounds, Reconstruction& result) {
  std::set<ObservationId> known;
  for (const auto& object : result.objects) {
    for (const Support& support : object.support) known.insert(support.id);
  }
  for (const Unexplained& unexplained : result.unexplained) known.insert(unexplained.id);
  for (std::size_t c = 0; c < components.size(); ++c) {
    for (std::size_t n = 0; n < components[c].sightings.size(); ++n) {
      const ObservationId id = components[c].sightings[n]->id;
      if (known.contains(id)) continue;
      result.unexplained.push_back(
          {id, done[c] ? reason_for(components[c], n, bounds) : "not looked at: stopped before"});
    }
  }
}

}  // namespace
}  // namespace detail

Reconstruction reconstruct_pnp(std::span<const CameraView> views, const KnowledgeBase& knowledge,
                               const ReconstructOptions& options, const StopToken& stop) {
  using namespace detail;
  Gathered gathered = gather(views, knowledge, options);
  leave_out_labels(gathered);
  const Bounds bounds{options.inlier_px};
  const std::vector<Component> components = split_into_components(gathered.sightings);
  std::vector<char> done;
  std::vector<Candidate> candidates = find_all(components, bounds, stop, done);
  reject_misread(candidates, bounds);
  weigh(candidates, views, options);
  if (!options.keep_ambiguous) reject_ambiguous(candidates);

  Reconstruction result{{}, std::move(gathered.unexplained), StopReason::none};
  if (std::count(done.begin(), done.end(), 0) > 0) result.stopped = stop.reason();
  for (const Candidate& candidate : candidates) {
    if (candidate.rejected.empty()) {
      result.objects.push_back(object_of(candidate));
      continue;
    }
    for (const Reading* reading : candidate.best().readings) {
      result.unexplained.push_back({reading->sighting->id, candidate.rejected});
    }
  }
  explain_rest(components, done, bounds, result);
  sort_result(knowledge, result);
  return result;
}

}  // namespace vantage
