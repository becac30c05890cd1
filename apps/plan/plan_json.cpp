#include "plan/plan_json.hpp"

#include "cli/inputs_json.hpp"
#include "cli/pose_json.hpp"
#include "cli/run_time.hpp"
#include "plan/candidate_json.hpp"
#include "plan/views_json.hpp"
#include "plan/volume_json.hpp"
#include "version.hpp"
#include "workcell/volume_settings.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Json plan_to_json(const Plan& plan, const ShadowRegions* regions,
                  const std::vector<ViewExplanation>& explained, const PlanRecord& record) {
  return {{"vantage", kVersion},
          {"method", plan.request.method.name},
          {"score_unit", plan.score_unit_name.empty() ? Json() : Json(plan.score_unit_name)},
          {"partial", plan.stopped != StopReason::none},
          {"finished_candidates", plan.finished},
          {"camera", camera_json(plan.request)},
          {"best", best_json(plan)},
          {"views", views_json(plan)},
          {"ranked", ranked_json(plan)},
          {"rejections", rejections_json(plan)},
          {"explanations", explanations_json(plan, explained)},
          {"candidates", candidates_json(plan)},
          {"volumes_m3", volumes_json(plan)},
          {"anti_alias", anti_alias_json(plan)},
          {"conflicts", conflicts_json(plan)},
          {"shadow_regions", regions_json(regions)},
          {"warnings", warnings_json(plan)},
          {"voxel_size_m", plan.request.voxel_size_m},
          {"timing_ms",
           {{"load", milliseconds(record.load_s)},
            {"classify", milliseconds(plan.classify_s)},
            {"score", milliseconds(plan.score_s)},
            {"total", milliseconds(record.total_s)}}},
          {"config", record.config},
          {"inputs", inputs_json(record.inputs)}};
}

Json camera_json(const PlanRequest& request) {
  const Intrinsics& k = request.intrinsics;
  return {{"width", k.width},
          {"height", k.height},
          {"fx", k.fx},
          {"fy", k.fy},
          {"cx", k.cx},
          {"cy", k.cy},
          {"near_m", request.range.near_m},
          {"far_m", request.range.far_m}};
}

namespace {

/// Null for the methods that it does not concern.
Json mesh_json(const MethodOptions& method) {
  if (method.name != "mesh") return nullptr;
  const VisibilityOptions& visibility = method.mesh.visibility;
  return {{"weight", method.mesh.weight == MeshWeight::volume ? "volume" : "depth"},
          {"step_px", visibility.step_px},
          {"holes", visibility.holes == DepthHoles::fill ? "fill" : "unknown"},
          {"fill_reach_px", visibility.fill_reach_px},
          {"offset_sigmas", visibility.offset_sigmas},
          {"opening_m", method.mesh.opening_m},
          {"enlarge", method.mesh.enlarge},
          {"image_width", method.mesh.image_width},
          {"exact_views", method.mesh.exact_views},
          {"shortlist", method.mesh.shortlist},
          {"shortlist_voxel_m", method.mesh.shortlist_voxel_m}};
}

}  // namespace

Json config_of(const PlanRequest& request) {
  Json travel;
  if (request.search.travel) {
    travel = {{"weight_per_m", request.search.travel->weight_per_m},
              {"from_m", to_json(request.search.travel->from_m)}};
  }
  return {
      {"work_area",
       {{"min_m", to_json(request.work_area.min())}, {"max_m", to_json(request.work_area.max())}}},
      {"candidates", config_of(request.candidates, request.work_area)},
      {"constraints", config_of(request.constraints)},
      {"depth_power", request.method.depth_power},
      {"mesh", mesh_json(request.method)},
      {"servo",
       {{"iterations", request.servo.iterations}, {"image_width", request.servo.image_width}}},
      {"polish", {{"views", request.polish.views}, {"image_width", request.polish.image_width}}},
      {"ranked", request.search.ranked},
      {"travel", travel},
      {"views",
       {{"most", request.views.most},
        {"least_gain_m3", request.views.least_gain_m3},
        {"least_gain_share", request.views.least_gain_share}}},
      {"volume", config_of(request.volume)}};
}

}  // namespace vantage
