#include <cmath>

#include "cli/pose_json.hpp"
#include "cli/units.hpp"
#include "evaluate/reconstruction/evaluation_report.hpp"
#include "version.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

Json scaled(const std::optional<double>& value, double scale = 1) {
  return value ? Json(*value * scale) : Json();
}

Json spread_json(const std::optional<Spread>& spread, double scale) {
  if (!spread) return nullptr;
  return {{"count", spread->count},
          {"mean", spread->mean * scale},
          {"deviation", spread->deviation * scale},
          {"median", spread->median * scale},
          {"largest", spread->largest * scale}};
}

Json summary_json(const RunSummary& summary) {
  return {{"runs", summary.runs},
          {"translation_mm", spread_json(summary.translation_m, kMillimetres)},
          {"rotation_deg", spread_json(summary.rotation_rad, kDegrees)},
          {"mssd_mm", spread_json(summary.mssd_m, kMillimetres)},
          {"self_consistency_mm2", spread_json(summary.self_consistency_mm2, 1)},
          {"true_objects", summary.true_objects},
          {"estimates", summary.estimates},
          {"found", summary.found},
          {"correct", summary.correct},
          {"recall", scaled(summary.recall)},
          {"precision", scaled(summary.precision)},
          {"average_recall_mssd", scaled(summary.average_recall)}};
}

Json bop_json(const std::optional<BopScores>& bop) {
  if (!bop) return nullptr;
  return {{"targets", bop->targets},
          {"ar", scaled(bop->average_recall())},
          {"ar_vsd", scaled(bop->ar_vsd)},
          {"ar_mssd", bop->ar_mssd},
          {"ar_mspd", bop->ar_mspd}};
}

/// What was reconstructed from all cameras, and BOP's errors of it.
Json estimates_json(const MethodEvaluation& method, const std::vector<TrueObject>& truth) {
  Json list = Json::array();
  for (const ReconstructedObject& object : method.from_all_cameras.objects) {
    list.push_back({{"type", object.type->name},
                    {"T_world_object", to_json(object.T_world_object)},
                    {"probability", object.probability},
                    {"object", nullptr}});
  }
  for (const EstimateErrors& errors : method.errors) {
    list[errors.estimate].update({{"object", truth[errors.truth].name},
                                  {"te_mm", errors.translation_m * kMillimetres},
                                  {"re_deg", errors.rotation_rad * kDegrees},
                                  {"add_mm", errors.add_m * kMillimetres},
                                  {"add_s_mm", errors.add_s_m * kMillimetres},
                                  {"mssd_mm", errors.mssd_m * kMillimetres}});
  }
  return list;
}

Json method_json(const MethodEvaluation& method, const std::vector<TrueObject>& truth) {
  Json by_cameras = Json::array();
  for (const auto& [cameras, summary] : method.by_cameras) {
    Json entry = {{"cameras", cameras}};
    entry.update(summary_json(summary));
    by_cameras.push_back(entry);
  }
  return {{"method", method.name},
          {"by_cameras", by_cameras},
          {"all", summary_json(method.all)},
          {"estimates", estimates_json(method, truth)},
          {"bop", bop_json(method.bop)}};
}

Json camera_json(const EvaluatedCamera& camera) {
  return {{"image", camera.image},
          {"reason", camera.reason.empty() ? Json() : Json(camera.reason)},
          {"observations", camera.observations},
          {"translation_error_mm", scaled(camera.translation_error_m, kMillimetres)},
          {"rotation_error_deg", scaled(camera.rotation_error_rad, kDegrees)}};
}

Json verdict_json(const ReconstructionScore& score, const std::vector<TrueObject>& truth) {
  Json objects = Json::array();
  for (const ObjectErrors& object : score.objects) {
    objects.push_back({{"object", truth[object.truth].name},
                       {"translation_mm", object.translation_m * kMillimetres},
                       {"rotation_deg", object.rotation_rad * kDegrees},
                       {"mssd_mm", object.mssd_m * kMillimetres}});
  }
  return {{"true_objects", score.true_objects},
          {"estimates", score.estimates},
          {"found", score.found},
          {"correct", score.correct},
          {"self_consistency_mm2", scaled(score.self_consistency_mm2)},
          {"objects", objects}};
}

Json run_json(const SubsetRun& run, const ReconstructionEvaluation& evaluation) {
  Json images = Json::array(), scores = Json::object();
  for (const std::size_t camera : evaluation.subsets[run.subset]) {
    images.push_back(evaluation.images[camera]);
  }
  for (std::size_t m = 0; m < run.scores.size(); ++m) {
    scores[evaluation.methods[m].name] = verdict_json(run.scores[m], evaluation.truth);
  }
  return {{"images", images}, {"trial", run.trial}, {"methods", scores}};
}

}  // namespace

Json evaluation_to_json(const ReconstructionEvaluation& evaluation) {
  Json objects = Json::array(), cameras = Json::array(), methods = Json::array();
  Json runs = Json::array();
  for (const TrueObject& object : evaluation.truth) {
    objects.push_back({{"name", object.name},
                       {"type", object.type->name},
                       {"T_world_object", to_json(object.T_world_object)}});
  }
  for (const EvaluatedCamera& camera : evaluation.cameras) cameras.push_back(camera_json(camera));
  for (const MethodEvaluation& method : evaluation.methods) {
    methods.push_back(method_json(method, evaluation.truth));
  }
  for (const SubsetRun& run : evaluation.runs) runs.push_back(run_json(run, evaluation));
  return {{"vantage", kVersion},
          {"true_objects", objects},
          {"touching_corner_pairs", evaluation.touching_pairs},
          {"cameras", cameras},
          {"subsets", evaluation.subsets.size()},
          {"methods", methods},
          {"runs", runs}};
}

}  // namespace vantage
