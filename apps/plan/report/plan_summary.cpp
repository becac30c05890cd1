#include "plan/report/plan_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace vantage {
namespace {

std::string rejections(const Plan& plan) {
  std::string text;
  for (const auto& [reason, count] : rejections_of(plan)) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, reason);
  }
  return text;
}

std::string camera_text(const Pose& T_world_cam) {
  const Eigen::Vector3d& p = T_world_cam.translation();
  const Eigen::Vector3d look = T_world_cam.rotation().col(2);
  return fmt::format("at [{:.3f}, {:.3f}, {:.3f}] m, looking along [{:.3f}, {:.3f}, {:.3f}]", p.x(),
                     p.y(), p.z(), look.x(), look.y(), look.z());
}

std::string reveals_text(const Plan& plan, std::uint64_t voxels) {
  const double revealed = plan.volume_m3(voxels);
  const double shadow = plan.classified->volume_m3(VoxelState::shadow);
  return fmt::format("{:.6f} m³, {:.1f} % of the shadow", revealed,
                     shadow > 0 ? 100 * revealed / shadow : 0.0);
}

/// Nothing for methods that look at all candidates.
std::string shortlist_text(const Plan& plan) {
  const auto pruned = std::count_if(plan.candidates.begin(), plan.candidates.end(),
                                    [](const ScoredCandidate& candidate) {
                                      return candidate.score.known == ScoreBound::Known::pruned;
                                    });
  const auto* const mesh = std::get_if<MeshMethod>(&plan.request.method);
  if (pruned == 0 || mesh == nullptr) return "";
  return fmt::format(
      "shortlist  {} candidates were passed over for less shadow in a carved grid of {} m\n",
      pruned, mesh->shortlist_voxel_m);
}

std::string origin_text(const Plan& plan, const RankedView& view) {
  std::string text = fmt::format("candidate {} of {}", plan.candidates[view.candidate].view.id,
                                 plan.candidates.size());
  if (view.servo_iteration > 0) text += fmt::format(", servo iteration {}", view.servo_iteration);
  if (!view.polish.empty()) {
    text += fmt::format(", polished by {} step{}", view.polish.size(),
                        view.polish.size() == 1 ? "" : "s");
  }
  return text;
}

std::string best_summary(const Plan& plan) {
  const RankedView& best = *plan.best();
  std::string text = fmt::format(
      "next view  {}\n"
      "camera     {}\n"
      "reveals    {}\n",
      origin_text(plan, best), camera_text(best.T_world_cam),
      reveals_text(plan, plan.views.front().revealed_voxels));
  if (!std::holds_alternative<VoxelMethod>(plan.request.method)) {
    text += fmt::format("score      {:.6g} {} (method {})\n", plan.in_units(best.score),
                        plan.score_unit_name, name_of(plan.request.method));
  }
  text += shortlist_text(plan);
  std::uint64_t revealed = plan.views.front().revealed_voxels;
  for (std::size_t i = 1; i < plan.views.size(); ++i) {
    const NextView& next = plan.views[i];
    revealed += next.revealed_voxels;
    text +=
        fmt::format("view {:<6}candidate {} {}\n           reveals {} more\n", i + 1,
                    plan.candidates[next.view.candidate].view.id,
                    camera_text(next.view.T_world_cam), reveals_text(plan, next.revealed_voxels));
  }
  if (plan.views.size() > 1) {
    text += fmt::format("together   {}\n", reveals_text(plan, revealed));
  }
  return text;
}

std::string no_view_summary(const Plan& plan) {
  if (plan.stopped != StopReason::none) return "stopped before any score\n";
  const bool all_rejected = std::all_of(
      plan.candidates.begin(), plan.candidates.end(),
      [](const ScoredCandidate& candidate) { return candidate.rejected != InvalidReason::none; });
  if (all_rejected) return "no feasible view: every candidate was rejected\n";
  if (plan.classified->count(VoxelState::shadow) == 0) return "no view: there is no shadow\n";
  return "no view: none of the candidates reveals any shadow\n";
}

std::string shadow_summary(const StateGrid& grid, const ShadowRegions& regions) {
  const double voxel_m3 = grid.geometry().voxel_volume_m3();
  const std::uint64_t unmeasured = grid.report().unmeasured_shadow;
  const std::uint64_t outside = grid.report().outside_shadow;
  std::string text = fmt::format(
      "shadow     {:.6f} m³ hidden, {:.6f} m³ without a reading, {:.6f} m³ outside all images; {} "
      "{}",
      double(grid.count(VoxelState::shadow) - unmeasured - outside) * voxel_m3,
      double(unmeasured) * voxel_m3, double(outside) * voxel_m3, regions.list().size(),
      regions.list().size() == 1 ? "region" : "regions");
  if (regions.list().size() > 1) {
    const ShadowRegion& largest = regions.list().front();
    text += fmt::format(", the largest {:.6f} m³ around [{:.3f}, {:.3f}, {:.3f}] m",
                        double(largest.voxels) * voxel_m3, largest.centroid_m.x(),
                        largest.centroid_m.y(), largest.centroid_m.z());
  }
  return text + "\n";
}

std::string volume_summary(const Plan& plan, const ShadowRegions& regions) {
  const StateGrid& grid = *plan.classified;
  const double voxel_m3 = grid.geometry().voxel_volume_m3();
  std::string text = fmt::format(
      "work area  {:.6f} m³ in voxels of {} m: occupied {:.6f}, free {:.6f}, shadow {:.6f} m³\n",
      grid.geometry().volume_m3(), plan.request.voxel_size_m, grid.volume_m3(VoxelState::occupied),
      grid.volume_m3(VoxelState::free), grid.volume_m3(VoxelState::shadow));
  text += shadow_summary(grid, regions);
  if (plan.request.volume.anti_aliased()) {
    text += fmt::format("anti-alias {:.6f} m³ of thin shadow became free\n",
                        double(grid.report().aliased_shadow) * voxel_m3);
  }
  for (const ObjectConflict& conflict : grid.report().conflicts) {
    text += fmt::format("conflict   {}: depth images see through {:.6f} of its {:.6f} m³\n",
                        conflict.object, double(conflict.voxels) * voxel_m3,
                        double(conflict.of_voxels) * voxel_m3);
  }
  return text;
}

std::string explanation(const Plan& plan, const ViewExplanation& view) {
  std::string text = fmt::format("\ncandidate {}: {}\n", view.candidate.id, view.verdict);
  for (std::size_t i = 0; i < view.trace.size(); ++i) {
    const ScoredStep& step = view.trace[i];
    text += fmt::format("  servo {:<2} {:<7} {}: {:.6g} {}{}\n", i, to_text(step.step.move),
                        camera_text(step.step.T_world_cam), plan.in_units(step.score.score),
                        plan.score_unit_name, i == view.best_step ? "  <- best" : "");
  }
  for (const ScoreTerm& term : view.terms) {
    text += fmt::format("  {:<22} {:.6g} {}\n", term.name, term.value, term.unit);
  }
  for (const RegionGain& gain : view.regions) {
    text += fmt::format("  of shadow region {:<5} {:.6f} of {:.6f} m³\n", gain.region + 1,
                        plan.volume_m3(gain.revealed), plan.volume_m3(gain.voxels));
  }
  return text;
}

}  // namespace

std::string summary_of(const Plan& plan, const ShadowRegions* regions,
                       const std::vector<ViewExplanation>& explained) {
  if (plan.classified == nullptr) return "stopped before the work area was classified: no view\n";
  std::string text = plan.best() != nullptr ? best_summary(plan) : no_view_summary(plan);
  if (plan.stopped != StopReason::none) {
    const bool searched = plan.finished == plan.candidates.size();
    text += fmt::format("partial    {} of {} candidates were finished{}\n", plan.finished,
                        plan.candidates.size(),
                        searched ? ", but not what comes after: polishing, further views" : "");
  }
  const std::string rejected = rejections(plan);
  if (!rejected.empty()) text += "rejected   " + rejected + "\n";
  text += volume_summary(plan, *regions);
  for (const ViewExplanation& view : explained) text += explanation(plan, view);
  return text;
}

}  // namespace vantage
