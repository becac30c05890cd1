// The benchmark of tracking, with trackers whose scores are known.

#include "evaluate/tracking/tracking_benchmark.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "evaluate/tracking/tracking_report.hpp"
#include "support/scene_count.hpp"
#include "support/test_data.hpp"
#include "workcell/random_objects.hpp"
#include "workcell/sequence/sequence_scene.hpp"

namespace vantage::test {
namespace {

using doctest::Approx;

Workcell small_clutter() {
  Workcell workcell = load_workcell(assets() / "workcells/clutter.yaml");
  choose_random_objects(workcell, 4, {"brick", "red_cube"});
  return workcell;
}

TrackingBenchmarkOptions short_sequences() {
  TrackingBenchmarkOptions options{.sequences = 2};
  options.sequence.instants = 30;
  options.sequence.moves = 2;
  options.sensor.depth_width = 0;
  return options;
}

/// Says nothing, ever.
const EvaluatedTracker kBlind{
    "blind", [](std::shared_ptr<const KnowledgeBase>, const SceneKnowledge&) -> SnapshotTracker {
      return [](const Snapshot&, const Reconstruction&) { return TrackedScene{}; };
    }};

/// Each snapshot as it is, with ids that are new every time.
const EvaluatedTracker kForgetful{
    "forgetful",
    [](std::shared_ptr<const KnowledgeBase>, const SceneKnowledge&) -> SnapshotTracker {
      return [next = TrackId(1)](const Snapshot& snapshot, const Reconstruction& alone) mutable {
        TrackedScene scene{.time_s = snapshot.time_s, .objects = {}, .events = {}, .snapshot = {}};
        for (const ReconstructedObject& object : alone.objects) {
          scene.objects.push_back({.id = next++,
                                   .type = object.type,
                                   .T_world_object = object.T_world_object,
                                   .existence = object.probability});
        }
        return scene;
      };
    }};

}  // namespace

TEST_CASE("a tracker that says nothing, and one that forgets, have the scores that they deserve") {
  const std::vector<EvaluatedTracker> trackers{kBlind, kForgetful};
  TrackingBenchmarkOptions options = short_sequences();
  options.perturbation = {};
  const TrackingEvaluation evaluation = evaluate_tracking(small_clutter(), trackers, options);
  CHECK(evaluation.sequences == 2);
  CHECK_FALSE(evaluation.partial);
  REQUIRE(evaluation.trackers.size() == 3);
  const TrackingScores& alone = evaluation.trackers[0].scores;
  CHECK(alone.instants == 60);
  CHECK(alone.hota.hota > 0.5);
  CHECK(alone.jitter.tracked.jitter().translation_m > 1e-5);
  CHECK(alone.jitter.tracked.jitter().translation_m < 3e-3);

  const TrackingScores& blind = evaluation.trackers[1].scores;
  CHECK(blind.hota.hota == 0);
  CHECK(blind.clear.misses == blind.clear.truth);
  CHECK(blind.events.found == 0);
  CHECK(blind.events.events >= blind.events.moves);
  CHECK(blind.events.moves == 4);
  CHECK(blind.lag.unsettled == 4);

  const TrackingScores& forgetful = evaluation.trackers[2].scores;
  CHECK(forgetful.hota.detection == Approx(alone.hota.detection));
  CHECK(forgetful.hota.association < 0.1);
  CHECK(forgetful.clear.switches > 100);
}

TEST_CASE("the benchmark's figures are the same every time, and as their schema says" *
          doctest::skip(kSanitized)) {
  const std::vector<EvaluatedTracker> trackers{kForgetful};
  const TrackingBenchmarkOptions options = short_sequences();
  const auto json = [&] {
    return tracking_to_json(evaluate_tracking(small_clutter(), trackers, options));
  };
  nlohmann::ordered_json result = json();
  CHECK(result == json());
  result["config"] = nlohmann::json::object();
  result["inputs"] = nlohmann::json::array();
  CHECK_NOTHROW(check_schema(Document{"tracking.json", nlohmann::json(result)}, tracking_schema()));
}

TEST_CASE("a benchmark that is stopped has no sequence that is not complete") {
  const StopToken stop;
  stop.cancel();
  const std::vector<EvaluatedTracker> trackers{kBlind};
  const TrackingEvaluation evaluation =
      evaluate_tracking(small_clutter(), trackers, short_sequences(), stop);
  CHECK(evaluation.partial);
  CHECK(evaluation.sequences == 0);
}

TEST_CASE("true events: what appears when it is first seen, moves, and is seen to be gone") {
  Workcell workcell = small_clutter();
  workcell.random_objects->seed = 5;
  place_random_objects(workcell);
  const SequenceScene scene = sequence_scene(workcell);
  SequencePlan plan{.instants = 12, .objects = {scene.objects[0], scene.objects[1]}};
  const Pose first = plan.objects[0].stays[0].T_world_object;
  const Pose second = Pose::from_rotation(first.rotation(), {0, 0.1, first.translation().z()});
  plan.objects[0].stays = {{.to_s = 0.25, .T_world_object = first},
                           {.from_s = 0.45, .T_world_object = second}};
  plan.objects[1].stays[0].to_s = 0.65;
  const SequenceSimulator simulator(plan, scene.fixed, scene.cameras, {.depth_width = 0}, 1);
  std::vector<std::vector<bool>> seen(12, {true, true});
  seen[0][0] = false;  // from the second instant on
  seen[5][0] = false;  // after its move from the seventh on
  const TypeModels types(*workcell.knowledge);
  const SequenceTruth truth = sequence_truth(simulator, seen, types);

  REQUIRE(truth.events.size() == 3);  // the second object was there from the start
  CHECK(truth.events[0].kind == SceneEventKind::appeared);
  CHECK(truth.events[0].due == 1);
  CHECK(truth.events[1].kind == SceneEventKind::moved);
  CHECK(truth.events[1].begin == 3);
  CHECK(truth.events[1].due == 6);
  CHECK(truth.events[1].to->translation() == second.translation());
  CHECK(truth.events[2].kind == SceneEventKind::disappeared);
  CHECK(truth.events[2].begin == 7);
  CHECK(truth.events[2].due >= 7);

  const auto judged = [&](std::size_t instant, std::uint64_t id) {
    return std::ranges::any_of(truth.frames[instant],
                               [&](const TruthAt& at) { return at.id == id && at.judged; });
  };
  CHECK_FALSE(judged(0, 1));
  CHECK(judged(2, 1));
  CHECK_FALSE(judged(3, 1));  // carried
  CHECK_FALSE(judged(5, 1));  // there, but nobody has seen it
  CHECK(judged(6, 1));
  CHECK(judged(6, 2));
  CHECK_FALSE(judged(7, 2));
}

}  // namespace vantage::test
