#include "evaluate/expected_gain/gain_benchmark.hpp"

#include <algorithm>

#include "evaluate/expected_gain/measured_gain.hpp"
#include "evaluate/planning/planning_benchmark.hpp"
#include "vantage/planner/advanced/expected_scorer.hpp"
#include "vantage/planner/advanced/voxel_scorer.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

constexpr std::uint64_t kSeed = 1000;  // of the movable camera's noise

}  // namespace

double CellGains::best_gain_m3() const {
  double best = 0;
  for (const auto* views : {&picks, &candidates}) {
    for (const GainedView& view : *views) best = std::max(best, view.gained_m3);
  }
  return best;
}

GainMethod gain_method(const std::string& name) {
  if (name == "expected") return {name, VoxelMethod{}, ViewValue::expected};
  if (name == "bound") return {name, VoxelMethod{}, ViewValue::bound};
  return {name, named_method(name).method, ViewValue::expected};
}

CellGains evaluate_expected_gain(const PlanningCell& cell, const std::vector<GainMethod>& methods,
                                 bool candidates, const StopToken& stop) {
  CellGains result{.name = cell.name};
  PlanRequest request = cell.request;
  const auto classified =
      classify(cell.world, GridGeometry::covering(request.work_area, request.voxel_size_m),
               request.volume, stop);
  if (classified == nullptr) return result;
  std::unique_ptr<MeasuredGain> truth;
  const PinholeCamera camera(request.intrinsics, Pose(), request.range);
  Plan plan{.request = request};
  for (const GainMethod& method : methods) {
    request.method = method.method;
    request.value = method.value;
    plan = plan_next_view(cell.world, classified, request, stop);
    if (stop.stop_requested()) return result;
    if (truth == nullptr) {
      result.shadow_m3 = plan.classified->volume_m3(VoxelState::shadow);
      result.false_shadow_m3 = plan.volume_m3(plan.classified->report().false_shadow);
      truth = std::make_unique<MeasuredGain>(cell.scene, cell.world, *plan.classified,
                                             request.volume, request.gain.sensor);
    }
    if (plan.best() == nullptr) continue;
    const RankedView& best = *plan.best();
    result.picks.push_back({method.name, plan.volume_m3(best.revealed_voxels.value()),
                            best.gain.value(),
                            truth->gain_m3(camera.moved_to(best.T_world_cam), kSeed)});
  }
  if (!candidates || truth == nullptr) return result;
  const PlanningScene scene(cell.world, plan.classified, request.volume.occluders);
  const ExpectedScorer expected(scene, cell.world, request.volume, request.gain_options());
  const VoxelScorer bound(scene);
  for (const ScoredCandidate& candidate : plan.candidates) {
    if (candidate.rejected != InvalidReason::none || stop.stop_requested()) continue;
    const PinholeCamera view = camera.moved_to(candidate.view.T_world_cam);
    const Score voxels = bound.ViewScorer::score(view).score;
    result.candidates.push_back({std::to_string(candidate.view.id), plan.volume_m3(voxels),
                                 expected.estimate(view), truth->gain_m3(view, kSeed)});
  }
  return result;
}

}  // namespace vantage
