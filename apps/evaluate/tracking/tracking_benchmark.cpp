#include "evaluate/tracking/tracking_benchmark.hpp"

#include <tbb/parallel_for.h>

#include "vantage/reconstruction/reconstruct.hpp"
#include "workcell/marker_dictionaries.hpp"
#include "workcell/sequence/sequence_scene.hpp"

namespace vantage {
namespace {

constexpr double kReported = 0.5;  // what is less likely to be there than not is no estimate

/// Every key that a detector may read by mistake.
std::vector<FeatureKey> misread_keys(const Workcell& workcell) {
  std::vector<FeatureKey> keys;
  for (const std::string& dictionary : dictionaries_of(workcell)) {
    const int count = marker_count(dictionary, "dictionary");
    for (int id = 0; id < count; ++id) keys.push_back(marker_key(dictionary, id));
  }
  return keys;
}

std::vector<EstimateAt> estimates_of(const Reconstruction& snapshot, const TypeModels& types) {
  std::vector<EstimateAt> estimates;
  for (const ReconstructedObject& object : snapshot.objects) {
    if (object.probability < kReported) continue;
    estimates.push_back({.id = 0,
                         .type = types.index.at(object.type.get()),
                         .T_world_object = object.T_world_object,
                         .covariance = object.covariance});
  }
  return estimates;
}

std::vector<EstimateAt> estimates_of(const TrackedScene& scene, const TypeModels& types) {
  std::vector<EstimateAt> estimates;
  for (const TrackedObject& object : scene.objects) {
    if (object.existence < kReported) continue;
    estimates.push_back({.id = object.id,
                         .type = types.index.at(object.type.get()),
                         .T_world_object = object.T_world_object,
                         .covariance = object.covariance});
  }
  return estimates;
}

std::optional<SceneEventKind> kind_of(TrackEventKind kind) {
  switch (kind) {
    case TrackEventKind::appeared:
    case TrackEventKind::discovered:
      return SceneEventKind::appeared;
    case TrackEventKind::moved:
      return SceneEventKind::moved;
    case TrackEventKind::disappeared:
      return SceneEventKind::disappeared;
    case TrackEventKind::views_disagree:
    case TrackEventKind::taken_back:
      break;
  }
  return {};
}

void add_reports(const TrackedScene& scene, int instant, const TypeModels& types,
                 std::vector<ReportedEvent>& reports) {
  for (const TrackEvent& event : scene.events) {
    const auto kind = kind_of(event.kind);
    if (!kind) continue;
    reports.push_back({*kind, types.index.at(event.type.get()), instant, event.from, event.to});
  }
}

/// A sequence as it was played and tracked: for snapshots alone, then for each tracker.
struct PlayedSequence {
  std::vector<std::vector<bool>> seen;
  std::vector<TrackedRun> runs;
};

/// What the sequences have in common.
class Benchmark {
 public:
  Benchmark(const Workcell& workcell, std::span<const EvaluatedTracker> trackers,
            const TrackingBenchmarkOptions& options, const StopToken& stop)
      : workcell_(workcell),
        trackers_(trackers),
        options_(options),
        stop_(stop),
        types_(*workcell.knowledge),
        keys_(misread_keys(workcell)) {}

  /// The scores of snapshots alone, then of each tracker; nothing if it was stopped.
  std::vector<TrackingScores> run(std::uint64_t seed) const {
    const SequenceSimulator simulator = simulator_of(seed);
    std::optional<PlayedSequence> played = play(simulator, seed);
    if (!played) return {};
    const SequenceTruth truth = sequence_truth(simulator, played->seen, types_);
    std::vector<TrackingScores> scores;
    for (TrackedRun& run : played->runs) {
      for (std::size_t i = 0; i < run.frames.size(); ++i) run.frames[i].truth = truth.frames[i];
    }
    for (const TrackedRun& run : played->runs) {
      scores.push_back(tracking_scores(run, played->runs.front(), truth.events, types_.models));
    }
    return scores;
  }

 private:
  SequenceSimulator simulator_of(std::uint64_t seed) const {
    Workcell cell = workcell_;
    if (cell.random_objects) cell.random_objects->seed = seed;
    place_random_objects(cell);
    const SequenceScene scene = sequence_scene(cell);
    RandomSequence sequence = options_.sequence;
    sequence.seed = seed;
    return SequenceSimulator(random_sequence(scene, sequence), scene.fixed, scene.cameras,
                             options_.sensor, seed);
  }

  std::vector<SnapshotTracker> started(const SequenceSimulator& simulator) const {
    std::vector<SnapshotTracker> trackers;
    for (const EvaluatedTracker& tracker : trackers_) {
      trackers.push_back(tracker.start(workcell_.knowledge, {simulator.fixed()}));
    }
    return trackers;
  }

  std::optional<PlayedSequence> play(const SequenceSimulator& simulator, std::uint64_t seed) const {
    PlayedSequence played;
    played.runs.resize(trackers_.size() + 1);
    const std::vector<SnapshotTracker> trackers = started(simulator);
    Perturbation perturbation = options_.perturbation;
    perturbation.seed = seed;
    for (int i = 0; i < simulator.plan().instants; ++i) {
      if (stop_.stop_requested()) return {};
      const SimulatedInstant instant = simulator.at(i);
      played.seen.push_back(instant.seen);
      const std::vector<CameraView> views =
          disturbed(instant.views, perturbation, std::uint64_t(i), keys_);
      const Reconstruction alone = reconstruct_pnp(views, *workcell_.knowledge);
      played.runs[0].frames.push_back({{}, estimates_of(alone, types_)});
      for (std::size_t t = 0; t < trackers.size(); ++t) {
        const TrackedScene scene = trackers[t]({instant.time_s, views, instant.depth}, alone);
        played.runs[t + 1].frames.push_back({{}, estimates_of(scene, types_)});
        add_reports(scene, i, types_, played.runs[t + 1].reports);
      }
      stop_.advance(1);
    }
    number_by_nearest(played.runs[0].frames, types_.models);
    return played;
  }

  const Workcell& workcell_;
  std::span<const EvaluatedTracker> trackers_;
  const TrackingBenchmarkOptions& options_;
  const StopToken& stop_;
  TypeModels types_;
  std::vector<FeatureKey> keys_;
};

}  // namespace

TrackingEvaluation evaluate_tracking(const Workcell& workcell,
                                     std::span<const EvaluatedTracker> trackers,
                                     const TrackingBenchmarkOptions& options,
                                     const StopToken& stop) {
  options.perturbation.check();
  options.sequence.check();
  const Benchmark benchmark(workcell, trackers, options, stop);
  const auto count = std::size_t(options.sequences);
  stop.expect(count * std::size_t(options.sequence.instants));
  std::vector<std::vector<TrackingScores>> scores(count);
  tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
    if (!stop.stop_requested()) scores[i] = benchmark.run(options.seed + i);
  });
  TrackingEvaluation evaluation;
  evaluation.trackers.push_back({"snapshots", {}});
  for (const EvaluatedTracker& tracker : trackers)
    evaluation.trackers.push_back({tracker.name, {}});
  for (const std::vector<TrackingScores>& one : scores) {
    if (one.empty()) continue;
    ++evaluation.sequences;
    for (std::size_t t = 0; t < one.size(); ++t) evaluation.trackers[t].scores.add(one[t]);
  }
  evaluation.partial = evaluation.sequences < count;
  return evaluation;
}

}  // namespace vantage
