#include "evaluate/planning/planning_json.hpp"

#include "cli/pose_json.hpp"
#include "evaluate/optional_json.hpp"
#include "metrics/planning/planning_tables.hpp"
#include "version.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

Json worth_json(const SceneEvaluation& scene, const PoseWorth& worth) {
  return {{"method_score", worth.method_score},
          {"vox_score_m3", worth.vox_score_m3},
          {"vox_ratio", or_null(vox_ratio(scene, worth))},
          {"true_gain_m3", worth.true_gain_m3}};
}

Json steps_json(const SceneEvaluation& scene, const Pick& pick) {
  Json steps = Json::array();
  for (const PickStep& step : pick.steps) {
    Json entry{{"move", step.move}};
    entry.update(worth_json(scene, step.worth));
    steps.push_back(entry);
  }
  return steps;
}

Json pick_json(const SceneEvaluation& scene, const SetEvaluation& set, const MethodRun& run) {
  if (!run.pick) return nullptr;
  Json json{{"id", run.pick->id},
            {"T_world_cam", to_json(run.pick->T_world_cam)},
            {"servo_iteration", run.pick->best_step}};
  json.update(worth_json(scene, run.pick->worth()));
  json["regret_m3"] = or_null(regret_m3(set, run));
  json["steps"] = steps_json(scene, *run.pick);
  return json;
}

Json set_json(const SceneEvaluation& scene, const SetEvaluation& set) {
  Json picks = Json::array();
  for (const MethodRun& run : set.runs) {
    picks.push_back(
        {{"method", run.method}, {"unit", run.unit}, {"pick", pick_json(scene, set, run)}});
  }
  return {{"set", set.set},
          {"radii_m", set.radii_m},
          {"views", set.views},
          {"feasible", set.feasible},
          {"best_true_gain_m3", set.best_true_gain_m3},
          {"methods", picks}};
}

Json scene_json(const SceneEvaluation& scene) {
  Json sets = Json::array();
  for (const SetEvaluation& set : scene.sets) sets.push_back(set_json(scene, set));
  return {{"name", scene.name},
          {"workcell", scene.workcell},
          {"cameras", scene.cameras},
          {"depth", scene.depth},
          {"voxel_size_m", scene.voxel_size_m},
          {"voxels",
           {{"free", scene.free_voxels},
            {"occupied", scene.occupied_voxels},
            {"shadow", scene.shadow_voxels}}},
          {"shadow_m3", scene.shadow_m3()},
          {"truly_hidden_m3", scene.truly_hidden_m3},
          {"vox_reference_m3", vox_reference_m3(scene)},
          {"remarks", remarks_on(scene)},
          {"sets", sets}};
}

Json means_json(const PlanningEvaluation& evaluation) {
  Json list = Json::array();
  for (const std::string& set : sets_of(evaluation)) {
    for (const std::string& method : evaluation.methods) {
      const MethodMeans means = means_of(evaluation, set, method);
      list.push_back({{"set", set},
                      {"method", method},
                      {"scenes", means.scenes},
                      {"vox_ratio", or_null(means.vox_ratio)},
                      {"true_gain_m3", or_null(means.true_gain_m3)},
                      {"regret_m3", or_null(means.regret_m3)}});
    }
  }
  return list;
}

Json quality_entry(const Json& scene, const std::string& method, const SetComparison& comparison) {
  return {{"scene", scene},
          {"method", method},
          {"production_of_full", comparison.production_share},
          {"vox_quality", comparison.vox_quality}};
}

Json quality_json(const PlanningEvaluation& evaluation) {
  Json list = Json::array();
  for (const SceneEvaluation& scene : evaluation.scenes) {
    for (const std::string& method : evaluation.methods) {
      if (const auto one = compare_sets(scene, method)) {
        list.push_back(quality_entry(scene.name, method, *one));
      }
    }
  }
  for (const std::string& method : evaluation.methods) {
    if (const auto mean = mean_comparison(evaluation, method)) {
      list.push_back(quality_entry(nullptr, method, *mean));
    }
  }
  return list;
}

Json scene_timing_json(const SceneEvaluation& scene) {
  Json runs = Json::array();
  for (const SetEvaluation& set : scene.sets) {
    for (const MethodRun& run : set.runs) {
      runs.push_back({{"set", set.set},
                      {"method", run.method},
                      {"median_s", or_null(median_run_time_s(run))},
                      {"run_times_s", run.run_times_s}});
    }
  }
  return {{"scene", scene.name}, {"classify_s", scene.classify_s}, {"runs", runs}};
}

Json timing_json(const PlanningEvaluation& evaluation) {
  Json scenes = Json::array(), means = Json::array(), speed_ups = Json::array();
  for (const SceneEvaluation& scene : evaluation.scenes) {
    scenes.push_back(scene_timing_json(scene));
  }
  for (const std::string& set : sets_of(evaluation)) {
    for (const std::string& method : evaluation.methods) {
      means.push_back({{"set", set},
                       {"method", method},
                       {"run_time_s", or_null(means_of(evaluation, set, method).run_time_s)}});
    }
  }
  for (const std::string& method : evaluation.methods) {
    const auto mean = mean_comparison(evaluation, method);
    if (mean) speed_ups.push_back({{"method", method}, {"speed_up", mean->speed_up()}});
  }
  return {{"scenes", scenes}, {"means", means}, {"production_speed_up", speed_ups}};
}

}  // namespace

Json planning_to_json(const PlanningEvaluation& evaluation) {
  Json scenes = Json::array();
  for (const SceneEvaluation& scene : evaluation.scenes) scenes.push_back(scene_json(scene));
  return {{"vantage", kVersion},
          {"methods", evaluation.methods},
          {"servo_iterations", evaluation.servo_iterations},
          {"polished_views", evaluation.polished_views},
          {"scenes", scenes},
          {"means", means_json(evaluation)},
          {"quality", quality_json(evaluation)},
          {"thesis", thesis_planning_json()},
          {"timing", timing_json(evaluation)}};
}

}  // namespace vantage
