#include "vantage/planner/plan.hpp"

#include <chrono>

#include "vantage/planner/voxel_scorer.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/volume/classify.hpp"

namespace vantage {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void score_candidates(const VoxelScorer& scorer, const PinholeCamera& camera, const StopToken& stop,
                      Plan& plan) {
  for (std::size_t i = 0; i < plan.candidates.size() && !stop.stop_requested(); ++i) {
    ScoredCandidate& candidate = plan.candidates[i];
    if (!candidate.rejected) {
      candidate.revealed_voxels =
          scorer.count_revealed(camera.moved_to(candidate.view.T_world_cam), stop);
    }
    if (candidate.rejected || candidate.revealed_voxels) stop.advance(1);
    const bool better =
        candidate.revealed_voxels &&
        (!plan.best || *candidate.revealed_voxels > *plan.candidates[*plan.best].revealed_voxels);
    if (better) plan.best = i;
  }
}

/// Whether every candidate was either rejected or scored.
bool complete(const Plan& plan) {
  for (const ScoredCandidate& candidate : plan.candidates) {
    if (!candidate.rejected && !candidate.revealed_voxels) return false;
  }
  return plan.grid != nullptr;
}

}  // namespace

std::optional<double> Plan::newly_observed_volume_m3(std::size_t candidate) const {
  const std::optional<std::uint64_t>& voxels = candidates.at(candidate).revealed_voxels;
  if (!voxels) return std::nullopt;
  return double(*voxels) * grid->geometry().voxel_volume_m3();
}

Plan plan_next_view(const WorldModel& world, const PlanRequest& request, const StopToken& stop) {
  Plan plan{request, {}, {}, nullptr, nullptr};
  if (plan.request.radii_m.empty()) plan.request.radii_m = default_radii_m(request.work_area);
  if (request.reach) request.reach->check("reach");
  const PinholeCamera camera(request.intrinsics, Pose(), request.range, "movable camera");
  const GridGeometry geometry = GridGeometry::covering(request.work_area, request.voxel_size_m);
  const std::vector<ViewCandidate> views = half_sphere_candidates(
      request.work_area.centre(), plan.request.radii_m, request.candidates_per_half_sphere);
  for (const ViewCandidate& view : views) plan.candidates.push_back({view, {}, {}});

  const auto start = std::chrono::steady_clock::now();
  plan.grid = plan.classified = classify(world, geometry, request.volume, stop);
  plan.classify_s = seconds_since(start);
  if (plan.grid != nullptr) {
    const auto scoring = std::chrono::steady_clock::now();
    stop.expect(plan.candidates.size());
    for (ScoredCandidate& candidate : plan.candidates) {
      candidate.rejected = reason_to_reject(candidate.view, request.reach, *plan.grid);
    }
    const VoxelScorer scorer(*plan.grid,
                             occluder_scene(world, *plan.grid, request.volume.occluders));
    score_candidates(scorer, camera, stop, plan);
    if (plan.best) {
      const Pose& pose = plan.candidates[*plan.best].view.T_world_cam;
      plan.grid = plan.grid->with_revealed(scorer.revealed(camera.moved_to(pose)));
    }
    plan.score_s = seconds_since(scoring);
  }
  // A stop that came after the last score took nothing away.
  if (!complete(plan)) plan.stopped = stop.reason();
  return plan;
}

}  // namespace vantage
