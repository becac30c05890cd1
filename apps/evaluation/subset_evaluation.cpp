#include "evaluation/subset_evaluation.hpp"

#include <tbb/parallel_for.h>

#include <numeric>
#include <set>

#include "evaluation/seen_objects.hpp"

namespace vantage {
namespace {

/// The views of every trial.
std::vector<std::vector<CameraView>> trials_of(std::span<const CameraView> views,
                                               const SubsetPlan& plan) {
  const std::set<FeatureKey> ignored(plan.ignored.begin(), plan.ignored.end());
  std::vector<std::vector<CameraView>> trials;
  for (std::size_t trial = 0; trial < plan.trials; ++trial) {
    trials.push_back(disturbed(views, plan.disturbance, trial, plan.keys));
    for (CameraView& view : trials.back()) {
      std::erase_if(view.observations,
                    [&](const Observation& seen) { return ignored.contains(seen.key); });
    }
  }
  return trials;
}

std::vector<CameraView> picked(const std::vector<CameraView>& views, const CameraSubset& subset) {
  std::vector<CameraView> some;
  for (const std::size_t view : subset) some.push_back(views[view]);
  return some;
}

}  // namespace

std::vector<SubsetRun> evaluate_subsets(std::span<const CameraView> views, const Judge& judge,
                                        std::span<const EvaluatedMethod> methods,
                                        const SubsetPlan& plan, const StopToken& stop) {
  const auto trials = trials_of(views, plan);
  const auto seen = seen_objects(views, judge.truth());
  std::vector<SubsetRun> runs(plan.subsets.size() * plan.trials);
  stop.expect(runs.size());
  tbb::parallel_for(std::size_t(0), runs.size(), [&](std::size_t i) {
    if (stop.stop_requested()) return;
    SubsetRun& run = runs[i];
    run = {i / plan.trials, i % plan.trials, {}};
    const CameraSubset& subset = plan.subsets[run.subset];
    const std::vector<CameraView> some = picked(trials[run.trial], subset);
    for (const EvaluatedMethod& method : methods) {
      run.verdicts.push_back(judge.judge(method.reconstruct(some), seen_by(seen, subset)));
    }
    stop.advance(1);
  });
  return runs;
}

std::vector<CameraSubset> covering_subsets(std::span<const CameraView> views,
                                           std::span<const TrueObject> truth,
                                           std::span<const CameraSubset> subsets) {
  const auto seen = seen_objects(views, truth);
  CameraSubset all(views.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  const std::vector<bool> by_all = seen_by(seen, all);
  std::vector<CameraSubset> covering;
  for (const CameraSubset& subset : subsets) {
    if (seen_by(seen, subset) == by_all) covering.push_back(subset);
  }
  return covering;
}

}  // namespace vantage
