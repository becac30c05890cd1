#include <algorithm>
#include <cmath>

#include "cli/units.hpp"
#include "evaluate/tracking/tracking_report.hpp"
#include "version.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

Json jitter_json(const JitterSums& sums) {
  const Jitter jitter = sums.jitter();
  return {{"poses", jitter.poses},
          {"translation_mm", jitter.translation_m * kMillimetres},
          {"rotation_deg", jitter.rotation_rad * kDegrees}};
}

Json events_json(const EventScores& events) {
  return {{"true", events.events},
          {"reported", events.reports},
          {"found", events.found},
          {"precision", events.precision()},
          {"recall", events.recall()},
          {"moves", events.moves},
          {"moves_found", events.moves_found},
          {"delays_instants", events.delays}};
}

Json consistency_json(const PoseConsistency& consistency) {
  Json json{{"samples", consistency.nees.size()},
            {"mean", nullptr},
            {"low", nullptr},
            {"high", nullptr},
            {"coverage", nullptr}};
  if (consistency.nees.empty()) return json;
  if (std::isfinite(consistency.mean())) json["mean"] = consistency.mean();
  json["low"] = consistency.low();
  json["high"] = consistency.high();
  json["coverage"] = consistency.coverage();
  return json;
}

Json scores_json(const TrackingScores& scores) {
  return {{"hota", scores.hota.hota},
          {"det_a", scores.hota.detection},
          {"ass_a", scores.hota.association},
          {"idf1", scores.identity.f1()},
          {"mota", scores.clear.accuracy()},
          {"id_switches", scores.clear.switches},
          {"type_switches", scores.clear.type_switches},
          {"phantoms_per_instant", scores.phantoms_per_instant()},
          {"events", events_json(scores.events)},
          {"lag", {{"instants", scores.lag.instants}, {"unsettled", scores.lag.unsettled}}},
          {"jitter", jitter_json(scores.jitter.tracked)},
          {"jitter_of_snapshots", jitter_json(scores.jitter.single)},
          {"nees", consistency_json(scores.consistency)}};
}

Json goals_json(const TrackingScores& scores) {
  Json list = Json::array();
  for (const TrackingGoal& goal : tracking_goals(scores)) {
    list.push_back({{"goal", goal.name}, {"found", goal.found}, {"reached", goal.reached}});
  }
  return list;
}

}  // namespace

Json tracking_to_json(const TrackingEvaluation& evaluation) {
  Json json{{"vantage", kVersion},
            {"partial", evaluation.partial},
            {"sequences", evaluation.sequences},
            {"trackers", Json::array()}};
  for (const EvaluatedTracking& tracker : evaluation.trackers) {
    json["trackers"].push_back({{"name", tracker.name},
                                {"scores", scores_json(tracker.scores)},
                                {"goals", goals_json(tracker.scores)}});
  }
  return json;
}

}  // namespace vantage
