#include "evaluate/shadow_filters/shadow_filter_json.hpp"

#include "evaluate/optional_json.hpp"
#include "version.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

Json filter_json(const ShadowFilterEvaluation& evaluation, std::size_t i) {
  const ShadowFilter& filter = evaluation.filters[i];
  const FilterMeans means = means_of(evaluation, i);
  return {{"offset_sigmas", filter.offset_sigmas},
          {"opening_voxels", filter.opening_voxels},
          {"least_m3", filter.min_m3},
          {"mean",
           {{"precision", or_null(means.precision)},
            {"recall", or_null(means.recall)},
            {"f1", or_null(means.f1)},
            {"false_m3", means.false_m3},
            {"missed_m3", means.missed_m3}}}};
}

Json score_json(const ShadowScore& score) {
  return {{"precision", or_null(score.precision())},
          {"recall", or_null(score.recall())},
          {"f1", or_null(score.f1())},
          {"true_m3", score.true_m3},
          {"false_m3", score.false_m3},
          {"missed_m3", score.missed_m3},
          {"boundary_m3", score.boundary_m3}};
}

Json scene_json(const FilteredScene& scene) {
  Json scores = Json::array();
  for (const ShadowScore& score : scene.scores) scores.push_back(score_json(score));
  return {{"name", scene.name}, {"hidden_m3", scene.hidden_m3}, {"filters", scores}};
}

}  // namespace

Json to_json(const ShadowFilterEvaluation& evaluation) {
  Json filters = Json::array(), scenes = Json::array();
  for (std::size_t i = 0; i < evaluation.filters.size(); ++i) {
    filters.push_back(filter_json(evaluation, i));
  }
  for (const FilteredScene& scene : evaluation.scenes) scenes.push_back(scene_json(scene));
  const auto best = best_filter(evaluation);
  return {{"vantage", kVersion},
          {"voxel_size_m", evaluation.voxel_size_m},
          {"filters", filters},
          {"best", best ? Json(*best) : Json()},
          {"scenes", scenes}};
}

}  // namespace vantage
