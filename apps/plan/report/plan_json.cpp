#include "plan/report/plan_json.hpp"

#include <algorithm>

#include "cli/inputs_json.hpp"
#include "cli/pose_json.hpp"
#include "cli/run_time.hpp"
#include "options/field_json.hpp"
#include "options/sensor_fields.hpp"
#include "options/view_options.hpp"
#include "options/volume_fields.hpp"
#include "plan/report/candidate_json.hpp"
#include "plan/report/views_json.hpp"
#include "version.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxRegions = 20;

double volume_m3(const Plan& plan, std::uint64_t voxels) {
  return double(voxels) * plan.classified->geometry().voxel_volume_m3();
}

Json region_json(const ShadowRegion& region, const GridGeometry& geometry) {
  const double voxel_m3 = geometry.voxel_volume_m3();
  return {{"volume_m3", double(region.voxels) * voxel_m3},
          {"unmeasured_m3", double(region.unmeasured_voxels) * voxel_m3},
          {"unseen_m3", double(region.outside_voxels) * voxel_m3},
          {"centroid_m", to_json(region.centroid_m)},
          {"min_m", to_json(geometry.corner(region.min_voxel))},
          {"max_m", to_json(geometry.corner(region.max_voxel + Eigen::Vector3i::Ones()))}};
}

}  // namespace

Json volumes_json(const Plan& plan) {
  if (plan.classified == nullptr) return nullptr;
  const StateGrid& grid = *plan.classified;
  const std::uint64_t unmeasured = grid.report().unmeasured_shadow;
  const std::uint64_t outside = grid.report().outside_shadow;
  const std::uint64_t hidden = grid.count(VoxelState::shadow) - unmeasured - outside;
  return {{"work_area", grid.geometry().volume_m3()},
          {"occupied", grid.volume_m3(VoxelState::occupied)},
          {"free", grid.volume_m3(VoxelState::free)},
          {"shadow", grid.volume_m3(VoxelState::shadow)},
          {"shadow_hidden", volume_m3(plan, hidden)},
          {"shadow_unmeasured", volume_m3(plan, unmeasured)},
          {"shadow_outside", volume_m3(plan, outside)},
          {"shadow_unseen", volume_m3(plan, outside)},
          {"false_shadow", volume_m3(plan, grid.report().false_shadow)}};
}

Json anti_alias_json(const Plan& plan) {
  if (plan.classified == nullptr) return nullptr;
  return {{"applied", plan.request.volume.anti_aliased()},
          {"volume_m3", volume_m3(plan, plan.classified->report().aliased_shadow)}};
}

Json conflicts_json(const Plan& plan) {
  if (plan.classified == nullptr) return nullptr;
  Json list = Json::array();
  for (const ObjectConflict& conflict : plan.classified->report().conflicts) {
    list.push_back({{"object", conflict.object},
                    {"volume_m3", volume_m3(plan, conflict.voxels)},
                    {"object_volume_m3", volume_m3(plan, conflict.of_voxels)}});
  }
  return list;
}

Json regions_json(const ShadowRegions* regions) {
  if (regions == nullptr) return nullptr;
  Json largest = Json::array();
  for (std::size_t r = 0; r < std::min(regions->list().size(), kMaxRegions); ++r) {
    largest.push_back(region_json(regions->list()[r], regions->geometry()));
  }
  return {{"count", regions->list().size()}, {"largest", largest}};
}

Json warnings_json(const Plan& plan, const std::vector<std::string>& of_input) {
  Json warnings = of_input;
  if (plan.classified == nullptr) return warnings;
  for (const std::string& warning : plan.classified->report().warnings) warnings.push_back(warning);
  return warnings;
}

Json plan_to_json(const Plan& plan, const ShadowRegions* regions,
                  const std::vector<ViewExplanation>& explained, const PlanRecord& record) {
  return {{"vantage", kVersion},
          {"method", name_of(plan.request.method)},
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
          {"warnings", warnings_json(plan, record.warnings)},
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

/// For the methods that know no such power: the usual one.
double depth_power_of(const Method& method) {
  if (const auto* const shadow = std::get_if<ShadowMethod>(&method)) return shadow->depth_power;
  if (const auto* const mesh = std::get_if<MeshMethod>(&method)) return mesh->depth_power;
  return ShadowMethod().depth_power;
}

/// Null for the methods that it does not concern.
Json mesh_json(const Method& method) {
  const auto* const by_mesh = std::get_if<MeshMethod>(&method);
  if (by_mesh == nullptr) return nullptr;
  MeshMethod mesh = *by_mesh;
  Json json{{"weight", mesh.weight == MeshWeight::volume ? "volume" : "depth"}};
  json.update(to_json(fields_of(mesh)));
  return json;
}

Json expected_gain_json(const ExpectedGainOptions& gain) {
  StereoSensor sensor = gain.sensor;
  return {{"sensor", sensor == StereoSensor::ideal() ? "ideal" : "stereo"},
          {"depth", to_json(fields_of(sensor))},
          {"unknown_depth", gain.unknown_depth}};
}

Json travel_json(const PlanRequest& request) {
  if (!request.search.travel) return nullptr;
  return {{"weight_per_m", request.search.travel->weight_per_m},
          {"from_m", to_json(request.search.travel->from_m)}};
}

Json volume_json(VolumeOptions volume) {
  volume.anti_alias = volume.anti_aliased();
  return to_json(fields_of(volume));
}

}  // namespace

Json config_of(const PlanRequest& used) {
  PlanRequest request = used;  // the descriptions point into it
  return {
      {"work_area",
       {{"min_m", to_json(request.work_area.min())}, {"max_m", to_json(request.work_area.max())}}},
      {"candidates", config_of(request.candidates, request.work_area)},
      {"constraints", config_of(request.constraints)},
      {"depth_power", depth_power_of(request.method)},
      {"value", request.value == ViewValue::expected ? "expected" : "bound"},
      {"expected_gain", expected_gain_json(request.gain)},
      {"mesh", mesh_json(request.method)},
      {"servo", to_json(fields_of(request.servo))},
      {"polish", to_json(fields_of(request.polish))},
      {"ranked", request.search.ranked},
      {"travel", travel_json(request)},
      {"views", to_json(fields_of(request.views))},
      {"volume", volume_json(request.volume)}};
}

}  // namespace vantage
