#pragma once

#include <span>

#include "metrics/tracking/event_scores.hpp"
#include "metrics/tracking/hota.hpp"
#include "metrics/tracking/identity_scores.hpp"
#include "metrics/tracking/pose_consistency.hpp"
#include "metrics/tracking/steadiness.hpp"

namespace vantage {

/// A tracker's result over one sequence, with the truth in every frame.
struct TrackedRun {
  std::vector<TrackFrame> frames;
  std::vector<ReportedEvent> reports;
};

/// What a tracker's result is worth.
struct TrackingScores {
  std::size_t runs = 0, instants = 0;
  HotaScores hota = {};  ///< mean over the runs
  IdentityScores identity = {};
  ClearScores clear = {};
  EventScores events = {};
  Lag lag = {};
  ComparedJitter jitter = {};  ///< beside that of the single snapshots
  PoseConsistency consistency = {};
  std::size_t phantoms =
      0;  ///< estimates that no true object of their type is near, of all instants

  double phantoms_per_instant() const {
    return instants == 0 ? 0 : double(phantoms) / double(instants);
  }
  void add(const TrackingScores& run);
};

/// Of one run.
/// @param single the same sequence by snapshots alone.
TrackingScores tracking_scores(const TrackedRun& run, const TrackedRun& single,
                               std::span<const TrueEvent> events,
                               std::span<const ErrorModel> models);

/// Gives ids to the estimates of each frame alone: each takes, the nearest pair first, that of the
/// estimate of its type in the frame before that is within a diameter, else a new one. What
/// tracking is held against.
void number_by_nearest(std::vector<TrackFrame>& frames, std::span<const ErrorModel> models);

}  // namespace vantage
