#include "plan_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace vantage {
namespace {

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
  const double shadow = plan.classified->volume_m3(VoxelState::shadow);
  return fmt::format(
      "next view  candidate {} of {}\n"
      "camera     at [{:.3f}, {:.3f}, {:.3f}] m, looking along [{:.3f}, {:.3f}, {:.3f}]\n"
      "reveals    {:.6f} m³, {:.1f} % of the shadow\n",
      best.view.id, plan.candidates.size(), p.x(), p.y(), p.z(), look.x(), look.y(), look.z(),
      revealed, shadow > 0 ? 100 * revealed / shadow : 0.0);
}

std::string shadow_summary(const StateGrid& grid, const ShadowRegions& regions) {
  const double voxel_m3 = grid.geometry().voxel_volume_m3();
  const std::uint64_t unseen = grid.report().unseen_shadow;
  std::string text = fmt::format(
      "shadow     {:.6f} m³ hidden, {:.6f} m³ that no image covers; {} {}",
      double(grid.count(VoxelState::shadow) - unseen) * voxel_m3, double(unseen) * voxel_m3,
      regions.list().size(), regions.list().size() == 1 ? "region" : "regions");
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

}  // namespace

std::string summary_of(const Plan& plan, const ShadowRegions* regions) {
  std::string text;
  if (plan.classified == nullptr) return "stopped before the work area was classified: no view\n";
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
  return text + volume_summary(plan, *regions);
}

}  // namespace vantage
