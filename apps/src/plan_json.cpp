#include "plan_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sha256.hpp"
#include "version.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Eigen::Vector3d& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

Json to_json(const Pose& pose) {
  const Eigen::Quaterniond q = pose.quaternion();
  return {{"rotation", {{"w", q.w()}, {"x", q.x()}, {"y", q.y()}, {"z", q.z()}}},
          {"translation_m", to_json(pose.translation())}};
}

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

/// As the given cameras left it: what the best view would reveal is shadow still.
double shadow_m3(const StateGrid& grid) {
  return grid.volume_m3(VoxelState::shadow) + grid.volume_m3(VoxelState::revealed);
}

Json volumes_json(const Plan& plan) {
  if (plan.grid == nullptr) return nullptr;
  return {{"work_area", plan.grid->geometry().volume_m3()},
          {"occupied", plan.grid->volume_m3(VoxelState::occupied)},
          {"free", plan.grid->volume_m3(VoxelState::free)},
          {"shadow", shadow_m3(*plan.grid)}};
}

double milliseconds(double seconds) {
  return std::round(seconds * 1e6) / 1e3;
}

std::string rejections(const Plan& plan) {
  std::map<std::string, int> counts;
  for (const ScoredCandidate& candidate : plan.candidates) {
    if (candidate.rejected) ++counts[*candidate.rejected];
  }
  std::string text;
  for (const auto& [reason, count] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, reason);
  }
  return text;
}

std::string best_summary(const Plan& plan) {
  const ScoredCandidate& best = plan.candidates[*plan.best];
  const Eigen::Vector3d& p = best.view.T_world_cam.translation();
  const Eigen::Vector3d look = best.view.T_world_cam.rotation().col(2);
  const double revealed = *plan.newly_observed_volume_m3(*plan.best);
  const double shadow = shadow_m3(*plan.grid);
  return fmt::format(
      "next view  candidate {} of {}\n"
      "camera     at [{:.3f}, {:.3f}, {:.3f}] m, looking along [{:.3f}, {:.3f}, {:.3f}]\n"
      "reveals    {:.6f} m³, {:.1f} % of the shadow\n",
      best.view.id, plan.candidates.size(), p.x(), p.y(), p.z(), look.x(), look.y(), look.z(),
      revealed, shadow > 0 ? 100 * revealed / shadow : 0.0);
}

}  // namespace

Json plan_to_json(const Plan& plan, const PlanRecord& record) {
  Json inputs = Json::array();
  for (const std::filesystem::path& path : record.inputs) {
    inputs.push_back({{"path", path.string()}, {"sha256", sha256_of_file(path)}});
  }
  return {{"vantage", kVersion},
          {"method", "voxel"},
          {"partial", plan.stopped != StopReason::none},
          {"camera", camera_json(plan.request)},
          {"best", best_json(plan)},
          {"candidates", candidates_json(plan)},
          {"volumes_m3", volumes_json(plan)},
          {"voxel_size_m", plan.request.voxel_size_m},
          {"timing_ms",
           {{"load", milliseconds(record.load_s)},
            {"classify", milliseconds(plan.classify_s)},
            {"score", milliseconds(plan.score_s)},
            {"total", milliseconds(record.total_s)}}},
          {"config", record.config},
          {"inputs", inputs}};
}

Json config_of(const PlanRequest& request) {
  Json config = {
      {"work_area",
       {{"min_m", to_json(request.work_area.min())}, {"max_m", to_json(request.work_area.max())}}},
      {"candidates",
       {{"set", "production"},
        {"radii_m", request.radii_m},
        {"count", request.candidates_per_half_sphere}}},
      {"reach", nullptr}};
  if (request.reach) {
    config["reach"] = {{"base_m", to_json(request.reach->base_m)},
                       {"min_m", request.reach->min_m},
                       {"max_m", request.reach->max_m}};
  }
  return config;
}

std::string summary_of(const Plan& plan) {
  std::string text;
  if (plan.grid == nullptr) return "stopped before the work area was classified: no view\n";
  if (plan.best) {
    text += best_summary(plan);
  } else {
    text += plan.stopped == StopReason::none ? "no feasible view\n" : "stopped before any score\n";
  }
  if (plan.stopped != StopReason::none) {
    const auto scored = std::count_if(plan.candidates.begin(), plan.candidates.end(),
                                      [](const auto& c) { return c.revealed_voxels.has_value(); });
    text +=
        fmt::format("partial    {} of {} candidates were scored\n", scored, plan.candidates.size());
  }
  const std::string rejected = rejections(plan);
  if (!rejected.empty()) text += "rejected   " + rejected + "\n";
  text += fmt::format(
      "work area  {:.6f} m³ in voxels of {} m: occupied {:.6f}, free {:.6f}, shadow {:.6f} m³\n",
      plan.grid->geometry().volume_m3(), plan.request.voxel_size_m,
      plan.grid->volume_m3(VoxelState::occupied), plan.grid->volume_m3(VoxelState::free),
      shadow_m3(*plan.grid));
  return text;
}

}  // namespace vantage
