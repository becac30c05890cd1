#include "plan/report/views_json.hpp"

#include <map>

#include "cli/pose_json.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

int id_of(const Plan& plan, const RankedView& view) {
  return plan.candidates[view.candidate].view.id;
}

Json trace_json(const Plan& plan, const std::vector<ScoredStep>& trace) {
  Json steps = Json::array();
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const ScoredStep& step = trace[i];
    steps.push_back(
        {{"iteration", i},
         {"move", to_text(step.step.move)},
         {"T_world_cam", to_json(step.step.T_world_cam)},
         {"score", step.score.exact() ? Json(plan.in_units(step.score.score)) : Json()}});
  }
  return steps;
}

Json polish_json(const RankedView& view) {
  Json steps = Json::array();
  for (const PolishStep& step : view.polish) {
    steps.push_back({{"move", to_text(step.move)},
                     {"by_rad", step.by_rad},
                     {"T_world_cam", to_json(step.T_world_cam)}});
  }
  return steps;
}

/// The volume that each candidate would reveal, as far as it was counted. What a polished view
/// reveals is not what its candidate would.
std::map<std::size_t, double> volumes_of_ranked(const Plan& plan) {
  std::map<std::size_t, double> volumes;
  for (const RankedView& view : plan.ranked) {
    if (view.revealed_voxels && view.polish.empty())
      volumes[view.candidate] = plan.volume_m3(*view.revealed_voxels);
  }
  return volumes;
}

/// What a view has in sight, and what of it to expect.
void add_gain(const Plan& plan, std::uint64_t revealed_voxels,
              const std::optional<GainEstimate>& gain, Json& json) {
  json["newly_observed_volume_m3"] = plan.volume_m3(revealed_voxels);
  if (!gain) return;
  json["expected_volume_m3"] = gain->expected_m3;
  json["expected_interval_m3"] = {gain->low_m3, gain->high_m3};
}

}  // namespace

Json best_json(const Plan& plan) {
  const RankedView* best = plan.best();
  if (best == nullptr) return nullptr;
  Json json{{"id", id_of(plan, *best)},
            {"T_world_cam", to_json(best->T_world_cam)},
            {"score", plan.in_units(best->score)}};
  add_gain(plan, best->revealed_voxels.value(), best->gain, json);
  json["servo_iteration"] = best->servo_iteration;
  json["servo_trace"] = trace_json(plan, plan.trace);
  json["polish"] = polish_json(*best);
  return json;
}

Json views_json(const Plan& plan) {
  Json views = Json::array();
  for (const NextView& next : plan.views) {
    views.push_back({{"id", id_of(plan, next.view)},
                     {"T_world_cam", to_json(next.view.T_world_cam)},
                     {"servo_iteration", next.view.servo_iteration},
                     {"polish", polish_json(next.view)}});
    add_gain(plan, next.revealed_voxels, next.view.gain, views.back());
  }
  return views;
}

Json ranked_json(const Plan& plan) {
  Json ranked = Json::array();
  for (const RankedView& view : plan.ranked) {
    ranked.push_back({{"id", id_of(plan, view)},
                      {"T_world_cam", to_json(view.T_world_cam)},
                      {"servo_iteration", view.servo_iteration},
                      {"polish", polish_json(view)},
                      {"score", plan.in_units(view.score)},
                      {"after_travel", plan.in_units(view.utility)}});
    add_gain(plan, view.revealed_voxels.value(), view.gain, ranked.back());
  }
  return ranked;
}

Json candidates_json(const Plan& plan) {
  const std::map<std::size_t, double> volumes = volumes_of_ranked(plan);
  const bool by_voxels = std::holds_alternative<VoxelMethod>(plan.request.method) &&
                         plan.request.value == ViewValue::bound;
  Json list = Json::array();
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    const ScoredCandidate& candidate = plan.candidates[i];
    const bool exact = candidate.score.exact();
    const bool bound = candidate.score.known == ScoreBound::Known::at_most;
    const double score = plan.in_units(candidate.score.score);
    const auto volume = volumes.find(i);
    Json counted = volume == volumes.end() ? Json() : Json(volume->second);
    if (exact && by_voxels) counted = score;  // that is the score
    const bool feasible = candidate.rejected == InvalidReason::none;
    list.push_back({{"id", candidate.view.id},
                    {"score", exact ? Json(score) : Json()},
                    {"score_at_most", exact || bound ? Json(score) : Json()},
                    {"newly_observed_volume_m3", counted},
                    {"servo_iteration", exact ? Json(candidate.servo_iteration) : Json()},
                    {"feasible", feasible},
                    {"rejected", feasible ? Json() : Json(candidate.rejection())}});
  }
  return list;
}

Json rejections_json(const Plan& plan) {
  Json json = Json::object();
  for (const auto& [reason, count] : rejections_of(plan))
    json[reason] = json.value(reason, std::size_t(0)) + count;
  return json;
}

Json explanations_json(const Plan& plan, const std::vector<ViewExplanation>& explained) {
  Json list = Json::array();
  for (const ViewExplanation& view : explained) {
    Json terms = Json::array(), regions = Json::array();
    for (const ScoreTerm& term : view.terms) {
      terms.push_back({{"name", term.name}, {"value", term.value}, {"unit", term.unit}});
    }
    for (const RegionGain& gain : view.regions) {
      regions.push_back({{"region", gain.region + 1},
                         {"volume_m3", plan.volume_m3(gain.voxels)},
                         {"revealed_m3", plan.volume_m3(gain.revealed)}});
    }
    const bool feasible = view.rejected == InvalidReason::none;
    list.push_back({{"id", view.candidate.id},
                    {"verdict", view.verdict},
                    {"rejected", feasible ? Json() : Json(view.rejection())},
                    {"newly_observed_volume_m3",
                     feasible ? Json(plan.volume_m3(view.revealed_voxels)) : Json()},
                    {"servo_iteration", feasible ? Json(view.best_step) : Json()},
                    {"servo_trace", trace_json(plan, view.trace)},
                    {"terms", terms},
                    {"regions", regions}});
  }
  return list;
}

}  // namespace vantage
