#include "plan/report/plan_summary.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "cli/volume_text.hpp"

namespace vantage {
namespace {

std::string rejections(const Plan& plan) {
  std::string text;
  for (const auto& [reason, count] : rejections_of(plan)) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, reason);
  }
  return text;
}

/// Which setting to change where the floor forbids most candidates.
std::string floor_hint(const Plan& plan) {
  const auto below = std::ranges::count(plan.candidates, InvalidReason::below_the_floor,
                                        &ScoredCandidate::rejected);
  if (2 * below < std::ssize(plan.candidates) || below == 0) return "";
  return fmt::format(
      "floor      most candidates are below the floor at z = {} m: if the floor is elsewhere, set "
      "--floor-z Z or none, or floor_z_m in the workcell\n",
      plan.request.constraints.floor_z_m.value_or(0));
}

/// A point in metres: three decimals in a work area of decimetres, more in a smaller one.
std::string point_text(const Plan& plan, const Eigen::Vector3d& p) {
  const double across_m = plan.request.work_area.size().norm();
  const int decimals = 3 + int(std::clamp(std::floor(-std::log10(across_m)), 0.0, 6.0));
  return fmt::format("[{:.{}f}, {:.{}f}, {:.{}f}] m", p.x(), decimals, p.y(), decimals, p.z(),
                     decimals);
}

std::string camera_text(const Plan& plan, const Pose& T_world_cam) {
  const Eigen::Vector3d look = T_world_cam.rotation().col(2);
  return fmt::format("at {}, looking along [{:.3f}, {:.3f}, {:.3f}]",
                     point_text(plan, T_world_cam.translation()), look.x(), look.y(), look.z());
}

/// The pose in full: a quaternion, and T_world_cam as a matrix.
std::string pose_text(const Pose& T_world_cam) {
  const Eigen::Quaterniond q(T_world_cam.rotation());
  std::string text = fmt::format("rotation   quaternion w {:.6f}, x {:.6f}, y {:.6f}, z {:.6f}\n",
                                 q.w(), q.x(), q.y(), q.z());
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = T_world_cam.rotation();
  matrix.topRightCorner<3, 1>() = T_world_cam.translation();
  for (int row = 0; row < 4; ++row) {
    text +=
        fmt::format("{:<12}[{:9.6f}, {:9.6f}, {:9.6f}, {:9.6f}]\n", row == 0 ? "T_world_cam" : "",
                    matrix(row, 0), matrix(row, 1), matrix(row, 2), matrix(row, 3));
  }
  return text;
}

double share_of_shadow(const Plan& plan, double part_m3) {
  const double shadow = plan.classified->volume_m3(VoxelState::shadow);
  return shadow > 0 ? part_m3 / shadow : 0;
}

std::string at_most_text(const Plan& plan, std::uint64_t voxels) {
  const double revealed = plan.volume_m3(voxels);
  return fmt::format("{}, {:.1f} % of the shadow", volume_text(revealed),
                     100 * share_of_shadow(plan, revealed));
}

/// "about 20 cm³ (18 cm³ to 23 cm³), at most 79 cm³, 40 % of the shadow". What is measured as part
/// of a surface may be more than what is in sight: then that is not the most.
std::string reveals_text(const Plan& plan, std::uint64_t voxels,
                         const std::optional<GainEstimate>& gain) {
  if (!gain) return "at most " + at_most_text(plan, voxels);
  const bool at_most = gain->high_m3 <= plan.volume_m3(voxels);
  return fmt::format("about {} ({} to {}), {} {}", volume_text(gain->expected_m3),
                     volume_text(gain->low_m3), volume_text(gain->high_m3),
                     at_most ? "at most" : "in sight", at_most_text(plan, voxels));
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
      "shortlist  {} candidates were left out, with less shadow in a carved grid of {} m\n", pruned,
      mesh->shortlist_voxel_m);
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
      "{}"
      "reveals    {}\n",
      origin_text(plan, best), camera_text(plan, best.T_world_cam), pose_text(best.T_world_cam),
      reveals_text(plan, plan.views.front().revealed_voxels, best.gain));
  if (!std::holds_alternative<VoxelMethod>(plan.request.method)) {
    text += fmt::format("score      {:.6g} {} (method {})\n", plan.in_units(best.score),
                        plan.score_unit_name, name_of(plan.request.method));
  }
  text += shortlist_text(plan);
  std::uint64_t revealed = plan.views.front().revealed_voxels;
  for (std::size_t i = 1; i < plan.views.size(); ++i) {
    const NextView& next = plan.views[i];
    revealed += next.revealed_voxels;
    text += fmt::format("view {:<6}candidate {} {}\n           reveals {} more\n", i + 1,
                        plan.candidates[next.view.candidate].view.id,
                        camera_text(plan, next.view.T_world_cam),
                        reveals_text(plan, next.revealed_voxels, next.view.gain));
  }
  if (plan.views.size() > 1) {
    text += fmt::format("together   at most {}\n", at_most_text(plan, revealed));
  }
  return text;
}

std::string no_view_summary(const Plan& plan) {
  if (plan.stopped != StopReason::none) return "stopped before any view was scored\n";
  const bool all_rejected = std::all_of(
      plan.candidates.begin(), plan.candidates.end(),
      [](const ScoredCandidate& candidate) { return candidate.rejected != InvalidReason::none; });
  if (all_rejected) return "no feasible view: every candidate was rejected\n";
  if (plan.classified->count(VoxelState::shadow) == 0) return "no view: there is no shadow\n";
  return "no view: none of the candidates reveals any shadow\n";
}

std::string shadow_summary(const Plan& plan, const ShadowRegions& regions) {
  const StateGrid& grid = *plan.classified;
  const double voxel_m3 = grid.geometry().voxel_volume_m3();
  const std::uint64_t unmeasured = grid.report().unmeasured_shadow;
  const std::uint64_t outside = grid.report().outside_shadow;
  const std::uint64_t hidden = grid.count(VoxelState::shadow) - unmeasured - outside;
  std::string text = fmt::format(
      "shadow     {} hidden, {} without a reading, {} outside all images; {} {}",
      volume_text(double(hidden) * voxel_m3), volume_text(double(unmeasured) * voxel_m3),
      volume_text(double(outside) * voxel_m3), regions.list().size(),
      regions.list().size() == 1 ? "region" : "regions");
  if (regions.list().size() > 1) {
    const ShadowRegion& largest = regions.list().front();
    text +=
        fmt::format(", the largest {} around {}", volume_text(double(largest.voxels) * voxel_m3),
                    point_text(plan, largest.centroid_m));
  }
  return text + "\n";
}

std::string volume_summary(const Plan& plan, const ShadowRegions& regions) {
  const StateGrid& grid = *plan.classified;
  const double voxel_m3 = grid.geometry().voxel_volume_m3();
  std::string text =
      fmt::format("work area  {} in voxels of {} m: occupied {}, free {}, shadow {}\n",
                  volume_text(grid.geometry().volume_m3()), plan.request.voxel_size_m,
                  volume_text(grid.volume_m3(VoxelState::occupied)),
                  volume_text(grid.volume_m3(VoxelState::free)),
                  volume_text(grid.volume_m3(VoxelState::shadow)));
  text += shadow_summary(plan, regions);
  if (plan.request.volume.anti_aliased()) {
    text += fmt::format("anti-alias {} of thin shadow became free\n",
                        volume_text(double(grid.report().aliased_shadow) * voxel_m3));
  }
  if (grid.report().false_shadow > 0) {
    text += fmt::format("filter     {} of thin shadow, which noise leaves, became free\n",
                        volume_text(double(grid.report().false_shadow) * voxel_m3));
  }
  for (const ObjectConflict& conflict : grid.report().conflicts) {
    text += fmt::format("conflict   {}: depth images see through {} of its {}\n", conflict.object,
                        volume_text(double(conflict.voxels) * voxel_m3),
                        volume_text(double(conflict.of_voxels) * voxel_m3));
  }
  return text;
}

std::string explanation(const Plan& plan, const ViewExplanation& view) {
  std::string text = fmt::format("\ncandidate {}: {}\n", view.candidate.id, view.verdict);
  for (std::size_t i = 0; i < view.trace.size(); ++i) {
    const ScoredStep& step = view.trace[i];
    text += fmt::format("  servo {:<2} {:<7} {}: {:.6g} {}{}\n", i, to_text(step.step.move),
                        camera_text(plan, step.step.T_world_cam), plan.in_units(step.score.score),
                        plan.score_unit_name, i == view.best_step ? "  <- best" : "");
  }
  for (const ScoreTerm& term : view.terms) {
    text += fmt::format("  {:<22} {:.6g} {}\n", term.name, term.value, term.unit);
  }
  for (const RegionGain& gain : view.regions) {
    text += fmt::format("  of shadow region {:<5} {} of {}\n", gain.region + 1,
                        volume_text(plan.volume_m3(gain.revealed)),
                        volume_text(plan.volume_m3(gain.voxels)));
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
                        searched ? ", but polishing or further views were not" : "");
  }
  const std::string rejected = rejections(plan);
  if (!rejected.empty()) text += "rejected   " + rejected + "\n";
  text += floor_hint(plan);
  text += volume_summary(plan, *regions);
  for (const ViewExplanation& view : explained) text += explanation(plan, view);
  return text;
}

}  // namespace vantage
