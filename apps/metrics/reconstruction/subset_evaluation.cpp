#include "metrics/reconstruction/subset_evaluation.hpp"

#include <tbb/parallel_for.h>

#include <numeric>
#include <set>

#include "metrics/reconstruction/seen_objects.hpp"

namespace vantage {
namespace {

/// What the cameras of a subset see in a trial.
std::vector<CameraView> seen_in(std::span<const CameraView> views, const CameraSubset& subset,
                                std::size_t trial, const SubsetPlan& plan,
                                const std::set<FeatureKey>& ignored) {
  const std::vector<CameraView> all = disturbed(views, plan.perturbation, trial, plan.keys);
  std::vector<CameraView> some;
  for (const std::size_t view : subset) {
    some.push_back(all[view]);
    std::erase_if(some.back().observations,
                  [&](const Observation& seen) { return ignored.contains(seen.key); });
  }
  return some;
}

}  // namespace

std::vector<SubsetRun> evaluate_subsets(std::span<const CameraView> views,
                                        const ReconstructionEvaluator& evaluator,
                                        std::span<const EvaluatedMethod> methods,
                                        const SubsetPlan& plan, const StopToken& stop) {
  const std::set<FeatureKey> ignored(plan.ignored.begin(), plan.ignored.end());
  const auto seen = seen_objects(views, evaluator.truth());
  std::vector<SubsetRun> runs(plan.subsets.size() * plan.trials);
  stop.expect(runs.size());
  tbb::parallel_for(std::size_t(0), runs.size(), [&](std::size_t i) {
    if (stop.stop_requested()) return;
    SubsetRun& run = runs[i];
    run = {i / plan.trials, i % plan.trials, {}};
    const CameraSubset& subset = plan.subsets[run.subset];
    const auto some = seen_in(views, subset, run.trial, plan, ignored);
    for (const EvaluatedMethod& method : methods) {
      run.scores.push_back(evaluator.evaluator(method.reconstruct(some), seen_by(seen, subset)));
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
