#include "metrics/tracking/tracking_scores.hpp"

#include <algorithm>

namespace vantage {
namespace {

std::size_t phantoms_in(std::span<const ComparedFrame> frames) {
  std::size_t count = 0;
  for (const ComparedFrame& frame : frames) {
    const auto matches = matches_of(frame);
    count += frame.estimates.size() -
             std::size_t(std::ranges::count_if(matches, [](const auto& m) { return bool(m); }));
  }
  return count;
}

void add_to_mean(double& mean, double value, std::size_t before, std::size_t more) {
  mean = (mean * double(before) + value * double(more)) / double(before + more);
}

/// Two estimates of neighbouring frames that may be one object.
struct NearPair {
  double distance_m = 0;
  std::size_t before = 0, now = 0;
  auto operator<=>(const NearPair&) const = default;
};

std::vector<NearPair> near_pairs(const TrackFrame& before, const TrackFrame& now,
                                 std::span<const ErrorModel> models) {
  std::vector<NearPair> pairs;
  for (std::size_t b = 0; b < before.estimates.size(); ++b) {
    for (std::size_t n = 0; n < now.estimates.size(); ++n) {
      if (before.estimates[b].type != now.estimates[n].type) continue;
      const double distance_m = (before.estimates[b].T_world_object.translation() -
                                 now.estimates[n].T_world_object.translation())
                                    .norm();
      if (distance_m < models[now.estimates[n].type].diameter_m)
        pairs.push_back({distance_m, b, n});
    }
  }
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace

void TrackingScores::add(const TrackingScores& run) {
  if (run.runs == 0) return;
  add_to_mean(hota.hota, run.hota.hota, runs, run.runs);
  add_to_mean(hota.detection, run.hota.detection, runs, run.runs);
  add_to_mean(hota.association, run.hota.association, runs, run.runs);
  runs += run.runs;
  instants += run.instants;
  identity.true_positives += run.identity.true_positives;
  identity.truth += run.identity.truth;
  identity.estimates += run.identity.estimates;
  clear.truth += run.clear.truth;
  clear.misses += run.clear.misses;
  clear.false_positives += run.clear.false_positives;
  clear.switches += run.clear.switches;
  clear.type_switches += run.clear.type_switches;
  events.add(run.events);
  lag.instants.insert(lag.instants.end(), run.lag.instants.begin(), run.lag.instants.end());
  lag.unsettled += run.lag.unsettled;
  jitter.tracked.add(run.jitter.tracked);
  jitter.single.add(run.jitter.single);
  consistency.add(run.consistency);
  phantoms += run.phantoms;
}

TrackingScores tracking_scores(const TrackedRun& run, const TrackedRun& single,
                               std::span<const TrueEvent> events,
                               std::span<const ErrorModel> models) {
  const std::vector<ComparedFrame> compared = compare(run.frames, models);
  const StandingErrors errors = standing_errors(run.frames, compared);
  const StandingErrors alone = standing_errors(single.frames, compare(single.frames, models));
  return {.runs = 1,
          .instants = run.frames.size(),
          .hota = hota(compared),
          .identity = identity_scores(compared),
          .clear = clear_scores(compared),
          .events = event_scores(events, run.reports, models),
          .lag = lag_of(events, errors),
          .jitter = compare_jitter(errors, alone),
          .consistency = pose_consistency(run.frames, compared),
          .phantoms = phantoms_in(compared)};
}

void number_by_nearest(std::vector<TrackFrame>& frames, std::span<const ErrorModel> models) {
  std::uint64_t next = 1;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (EstimateAt& estimate : frames[i].estimates) estimate.id = 0;
    if (i > 0) {
      std::vector<bool> taken(frames[i - 1].estimates.size(), false);
      for (const NearPair& pair : near_pairs(frames[i - 1], frames[i], models)) {
        EstimateAt& now = frames[i].estimates[pair.now];
        if (taken[pair.before] || now.id != 0) continue;
        now.id = frames[i - 1].estimates[pair.before].id;
        taken[pair.before] = true;
      }
    }
    for (EstimateAt& estimate : frames[i].estimates) {
      if (estimate.id == 0) estimate.id = next++;
    }
  }
}

}  // namespace vantage
