#pragma once

#include <functional>
#include <string>
#include <vector>

#include "evaluate/tracking/sequence_truth.hpp"
#include "metrics/reconstruction/perturbation.hpp"
#include "metrics/tracking/tracking_scores.hpp"
#include "simulator/sequence/random_sequence.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/reconstruction/tracking.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

/// Takes one snapshot after the other, each with the reconstruction of it alone.
using SnapshotTracker = std::function<TrackedScene(const Snapshot&, const Reconstruction&)>;

/// A way to track. `start` is called for each sequence, from many threads at once.
struct EvaluatedTracker {
  std::string name;
  std::function<SnapshotTracker(std::shared_ptr<const KnowledgeBase>, const SceneKnowledge&)> start;
};

/// ObjectTracker with each of these filters.
std::vector<EvaluatedTracker> object_trackers(std::span<const TemporalFilter> filters);

struct TrackingBenchmarkOptions {
  int sequences = 20;
  std::uint64_t seed = 1;  ///< of the first sequence; the next has the next one
  RandomSequence sequence = {};
  FeatureSensor sensor = {};
  Perturbation perturbation = {.drop = 0.2, .wrong_ids = 0.05};  ///< its seed is the sequence's
};

/// The scores of one tracker, and of the same sequences by snapshots alone.
struct EvaluatedTracking {
  std::string name;
  TrackingScores scores;
};

struct TrackingEvaluation {
  std::size_t sequences = 0;                ///< that are complete
  bool partial = false;                     ///< stopped before all were
  std::vector<EvaluatedTracking> trackers;  ///< "snapshots" first
};

/// Runs every tracker over seeded sequences in a workcell, in the caller's task arena; the same
/// result at any number of threads. Stopped, it has the sequences that are complete.
/// @param workcell its `random_objects` are placed anew for every sequence.
/// @throws Error bad_input as `place_random_objects`, `sequence_scene`, `random_sequence`,
/// `SequenceSimulator` and the trackers do.
TrackingEvaluation evaluate_tracking(const Workcell& workcell,
                                     std::span<const EvaluatedTracker> trackers,
                                     const TrackingBenchmarkOptions& options,
                                     const StopToken& stop = {});

}  // namespace vantage
