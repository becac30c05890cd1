#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vantage/raycore/pose.hpp"

namespace vantage {

/// What a pose is worth.
struct PoseWorth {
  double method_score = 0;  ///< by the method itself, in `MethodRun::unit`
  double vox_score_m3 = 0;  ///< by the voxel method (thesis 9.1)
  double true_gain_m3 = 0;  ///< truly hidden volume that it really sees
};

/// A servo iteration on the way to a pick; the first is the candidate itself, and the last is
/// where polishing led if that is the pick.
struct PickStep {
  std::string move;
  PoseWorth worth;
};

/// The view that a method picked.
struct Pick {
  int id = 0;  ///< of the candidate
  Pose T_world_cam;
  std::vector<PickStep> steps;
  std::size_t best_step = 0;  ///< which of them was picked

  const PoseWorth& worth() const { return steps.at(best_step).worth; }
};

/// One method on one set of candidates.
struct MethodRun {
  std::string method;                 ///< e.g. "voxel", "shadowD6"
  std::string unit;                   ///< of its score
  std::optional<Pick> pick;           ///< none: no view is feasible, or none is worth anything
  std::vector<double> run_times_s{};  ///< of planning in a work area that is classified already
};

/// One set of candidates in one scene.
struct SetEvaluation {
  std::string set;  ///< "full" or "production"
  std::size_t views = 0, feasible = 0;
  std::vector<double> radii_m;    ///< of its half-spheres
  double best_true_gain_m3 = 0;   ///< the best known: over all feasible views and their servo
                                  ///< iterations, polished by that gain, and over the picks
  std::vector<MethodRun> runs{};  ///< in the order of `PlanningEvaluation::methods`
};

/// A workcell, as some of its cameras see it.
struct SceneEvaluation {
  std::string
      name;  ///< e.g. "wall:front"; with the depth images' kind, "foreign_objects:front+ideal"
  std::string workcell;
  std::vector<std::string> cameras{};
  std::string depth = "none";  ///< "ideal", "noisy": depth images as well as known objects
  double voxel_size_m = 0;
  std::uint64_t free_voxels = 0, occupied_voxels = 0, shadow_voxels = 0;
  double truly_hidden_m3 = 0;
  std::vector<double> classify_s{};  ///< run times
  std::vector<SetEvaluation> sets{};

  double voxel_m3() const { return voxel_size_m * voxel_size_m * voxel_size_m; }
  double shadow_m3() const { return double(shadow_voxels) * voxel_m3(); }
};

/// The thesis' chapter 9 on simulated scenes. The first method is `voxel`, which the others are
/// compared with; the full set, if there is one, comes first.
struct PlanningEvaluation {
  std::vector<std::string> methods;
  int servo_iterations = 0;
  std::vector<SceneEvaluation> scenes;
  int polished_views = 0;  ///< number of a method's best
};

/// A method's run in a set; null if there is none.
const MethodRun* run_of(const SceneEvaluation& scene, const std::string& set,
                        const std::string& method);

/// The vox score that ratios are against: that of the voxel method's pick in the scene's first set.
/// 0 if there is none.
double vox_reference_m3(const SceneEvaluation& scene);

/// Vox score by the reference; none if that is 0.
std::optional<double> vox_ratio(const SceneEvaluation& scene, const PoseWorth& worth);

/// The median; none if it was never timed.
std::optional<double> median_run_time_s(const MethodRun& run);

/// The best true gain that is known of the set, less that of the pick; never negative.
/// None without a pick.
std::optional<double> regret_m3(const SetEvaluation& set, const MethodRun& run);

/// A method with the production set against the same with the full one, in one scene.
struct SetComparison {
  double vox_quality = 0;  ///< thesis: vox score full / production; below 1: production is better
  double production_share = 0;  ///< the other way round; from 1 on, production is as good
  double full_s = 0, production_s = 0;
  double speed_up() const { return full_s / production_s; }
};

/// None unless both sets were evaluated, gave picks with a vox score, and were timed.
std::optional<SetComparison> compare_sets(const SceneEvaluation& scene, const std::string& method);

/// Means over the scenes that have values.
struct MethodMeans {
  std::size_t scenes = 0;  ///< with a vox ratio
  std::optional<double> vox_ratio, run_time_s, true_gain_m3, regret_m3;
};
MethodMeans means_of(const PlanningEvaluation& evaluation, const std::string& set,
                     const std::string& method);

/// Means over the scenes; the times' too, so that their quotient is the whole's speed-up.
std::optional<SetComparison> mean_comparison(const PlanningEvaluation& evaluation,
                                             const std::string& method);

}  // namespace vantage
