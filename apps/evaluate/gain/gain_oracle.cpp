#include "evaluate/gain/gain_oracle.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "vantage/planner/advanced/view_validity_checker.hpp"

namespace vantage {
namespace {

/// The poses of the full set at which the camera may be.
std::vector<Pose> feasible_of_full_set(const JudgedPlan& plan, const StateGrid& shadow) {
  const PlanRequest& request = plan.input.request;
  const auto grid = std::shared_ptr<const StateGrid>(std::shared_ptr<void>(), &shadow);
  const PlanningScene scene(plan.input.world, grid, request.volume.occluders);
  const ViewValidityChecker validity(request.constraints, scene, request.range);
  std::vector<Pose> poses;
  for (const ViewCandidate& view : view_candidates(full_views(), request.work_area)) {
    if (validity.examine(view.T_world_cam).valid()) poses.push_back(view.T_world_cam);
  }
  return poses;
}

std::size_t points_in_view(const Points& points, const PinholeCamera& view) {
  std::vector<std::uint8_t> in_view(points.size());
  view.in_view(points, in_view);
  return std::size_t(std::ranges::count(in_view, std::uint8_t(1)));
}

}  // namespace

GainCandidates::GainCandidates(const JudgedPlan& plan, const StateGrid& shadow, GainOracle oracle)
    : voxel_m3_(shadow.geometry().voxel_volume_m3()) {
  if (oracle == GainOracle::none) return;
  const PlanRequest& request = plan.input.request;
  const PinholeCamera camera(request.intrinsics, Pose(), request.range);
  std::vector<Pose> poses = plan.ranked;
  const auto candidates = view_candidates(request.candidates, request.work_area);
  for (const std::size_t i : plan.feasible) {
    if (i < candidates.size()) poses.push_back(candidates[i].T_world_cam);
  }
  if (oracle == GainOracle::full) {
    const std::vector<Pose> full = feasible_of_full_set(plan, shadow);
    poses.insert(poses.end(), full.begin(), full.end());
  }
  for (const Pose& pose : poses) views_.push_back(camera.moved_to(pose));
}

std::optional<double> GainCandidates::best_m3(MeasuredGain& truth, std::uint64_t seed,
                                              const StopToken& stop) const {
  if (views_.empty()) return std::nullopt;
  std::vector<std::size_t> most(views_.size()), order(views_.size());
  tbb::parallel_for(std::size_t(0), views_.size(),
                    [&](std::size_t i) { most[i] = points_in_view(truth.left(), views_[i]); });
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return most[a] > most[b]; });
  double best = 0;
  for (const std::size_t i : order) {
    if (stop.stop_requested() || double(most[i]) * voxel_m3_ <= best) break;
    best = std::max(best, truth.gain_m3(views_[i], seed));
    stop.advance(1);
  }
  return best;
}

}  // namespace vantage
