#include "metrics/planning/planning_evaluation.hpp"

#include <algorithm>

#include "metrics/plot/run_summary.hpp"

namespace vantage {
namespace {

std::optional<double> mean_of(const std::vector<double>& values) {
  const auto spread = spread_of(values);
  return spread ? std::optional(spread->mean) : std::nullopt;
}

void append(std::vector<double>& values, const std::optional<double>& value) {
  if (value) values.push_back(*value);
}

const SetEvaluation* set_of(const SceneEvaluation& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.sets, name, &SetEvaluation::set);
  return found == scene.sets.end() ? nullptr : &*found;
}

}  // namespace

const MethodRun* run_of(const SceneEvaluation& scene, const std::string& set,
                        const std::string& method) {
  const SetEvaluation* const evaluated = set_of(scene, set);
  if (evaluated == nullptr) return nullptr;
  const auto run = std::ranges::find(evaluated->runs, method, &MethodRun::method);
  return run == evaluated->runs.end() ? nullptr : &*run;
}

double vox_reference_m3(const SceneEvaluation& scene) {
  if (scene.sets.empty()) return 0;
  const MethodRun* const voxel = run_of(scene, scene.sets.front().set, "voxel");
  return voxel != nullptr && voxel->pick ? voxel->pick->worth().vox_score_m3 : 0;
}

std::optional<double> vox_ratio(const SceneEvaluation& scene, const PoseWorth& worth) {
  const double reference = vox_reference_m3(scene);
  return reference > 0 ? std::optional(worth.vox_score_m3 / reference) : std::nullopt;
}

std::optional<double> median_run_time_s(const MethodRun& run) {
  const auto spread = spread_of(run.run_times_s);
  return spread ? std::optional(spread->median) : std::nullopt;
}

std::optional<double> regret_m3(const SetEvaluation& set, const MethodRun& run) {
  if (!run.pick) return std::nullopt;
  return set.best_true_gain_m3 - run.pick->worth().true_gain_m3;
}

std::optional<SetComparison> compare_sets(const SceneEvaluation& scene, const std::string& method) {
  const MethodRun *const full = run_of(scene, "full", method), *const production = run_of(
                                                                   scene, "production", method);
  if (full == nullptr || production == nullptr || !full->pick || !production->pick) return {};
  const double all = full->pick->worth().vox_score_m3, few = production->pick->worth().vox_score_m3;
  const auto full_s = median_run_time_s(*full), production_s = median_run_time_s(*production);
  if (all <= 0 || few <= 0 || !full_s || !production_s) return {};
  return SetComparison{all / few, few / all, *full_s, *production_s};
}

MethodMeans means_of(const PlanningEvaluation& evaluation, const std::string& set,
                     const std::string& method) {
  std::vector<double> ratios, times, gains, regrets;
  for (const SceneEvaluation& scene : evaluation.scenes) {
    const MethodRun* const run = run_of(scene, set, method);
    if (run == nullptr || !run->pick) continue;
    append(ratios, vox_ratio(scene, run->pick->worth()));
    append(times, median_run_time_s(*run));
    gains.push_back(run->pick->worth().true_gain_m3);
    append(regrets, regret_m3(*set_of(scene, set), *run));
  }
  return {ratios.size(), mean_of(ratios), mean_of(times), mean_of(gains), mean_of(regrets)};
}

std::optional<SetComparison> mean_comparison(const PlanningEvaluation& evaluation,
                                             const std::string& method) {
  SetComparison sum;
  double scenes = 0;
  for (const SceneEvaluation& scene : evaluation.scenes) {
    const auto one = compare_sets(scene, method);
    if (!one) continue;
    ++scenes;
    sum.vox_quality += one->vox_quality;
    sum.production_share += one->production_share;
    sum.full_s += one->full_s;
    sum.production_s += one->production_s;
  }
  if (scenes == 0) return {};
  return SetComparison{sum.vox_quality / scenes, sum.production_share / scenes, sum.full_s / scenes,
                       sum.production_s / scenes};
}

}  // namespace vantage
