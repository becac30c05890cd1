#include "plan_json.hpp"

#include <cmath>

#include "inputs_json.hpp"
#include "pose_json.hpp"
#include "version.hpp"
#include "volume_json.hpp"
#include "volume_settings.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
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

Json best_json(const Plan& plan) {
  if (!plan.best) return nullptr;
  const ViewCandidate& view = plan.candidates[*plan.best].view;
  const double volume = *plan.newly_observed_volume_m3(*plan.best);
  return {{"id", view.id},
          {"T_world_cam", to_json(view.T_world_cam)},
          {"score", volume},
          {"newly_observed_volume_m3", volume},
          {"servo_iteration", 0}};
}

Json candidates_json(const Plan& plan) {
  Json list = Json::array();
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    const ScoredCandidate& candidate = plan.candidates[i];
    const Json volume = number_or_null(plan.newly_observed_volume_m3(i));
    list.push_back({{"id", candidate.view.id},
                    {"score", volume},
                    {"newly_observed_volume_m3", volume},
                    {"feasible", !candidate.rejected.has_value()},
                    {"rejected", candidate.rejected ? Json(*candidate.rejected) : Json()}});
  }
  return list;
}

double milliseconds(double seconds) {
  return std::round(seconds * 1e6) / 1e3;
}

}  // namespace

Json plan_to_json(const Plan& plan, const ShadowRegions* regions, const PlanRecord& record) {
  return {{"vantage", kVersion},
          {"method", "voxel"},
          {"partial", plan.stopped != StopReason::none},
          {"camera", camera_json(plan.request)},
          {"best", best_json(plan)},
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

Json config_of(const PlanRequest& request) {
  Json config = {
      {"work_area",
       {{"min_m", to_json(request.work_area.min())}, {"max_m", to_json(request.work_area.max())}}},
      {"candidates",
       {{"set", "production"},
        {"radii_m", request.radii_m},
        {"count", request.candidates_per_half_sphere}}},
      {"reach", nullptr},
      {"volume", config_of(request.volume)}};
  if (request.reach) {
    config["reach"] = {{"base_m", to_json(request.reach->base_m)},
                       {"min_m", request.reach->min_m},
                       {"max_m", request.reach->max_m}};
  }
  return config;
}

}  // namespace vantage
