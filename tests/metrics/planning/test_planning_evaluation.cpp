#include "metrics/planning/planning_evaluation.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "metrics/planning_examples.hpp"

namespace vantage {
namespace {

using test::two_scenes;
using test::wall_scene;

void expect_near(const std::optional<double>& value, double expected) {
  REQUIRE(value);
  CHECK(std::abs(*value - expected) < 1e-12);
}

}  // namespace

TEST_CASE("ratios are against the voxel method's pick from the first set") {
  const SceneEvaluation scene = wall_scene();
  CHECK(vox_reference_m3(scene) == 8e-4);
  expect_near(vox_ratio(scene, run_of(scene, "full", "shadowD6")->pick->worth()), 0.95);
  expect_near(vox_ratio(scene, run_of(scene, "production", "shadowD6")->pick->worth()), 1);
  CHECK(run_of(scene, "full", "mesh") == nullptr);
  CHECK(run_of(scene, "other", "voxel") == nullptr);
}

TEST_CASE("without a reference there is no ratio") {
  const SceneEvaluation empty = two_scenes().scenes[1];
  CHECK(vox_reference_m3(empty) == 0);
  CHECK_FALSE(vox_ratio(empty, {}));
  CHECK_FALSE(vox_ratio({}, {1, 1, 1}));
  CHECK_FALSE(compare_sets(empty, "voxel"));
}

TEST_CASE("regret is what the best of the same set would have gained more") {
  const SceneEvaluation scene = wall_scene();
  expect_near(regret_m3(scene.sets[0], scene.sets[0].runs[1]), 1e-4);
  expect_near(regret_m3(scene.sets[1], scene.sets[1].runs[1]), 0.5e-4);
  CHECK_FALSE(regret_m3(scene.sets[0], {"mesh", "", {}, {}}));
}

TEST_CASE("sets are compared in both directions, and by medians of the run times") {
  SceneEvaluation scene = wall_scene();
  scene.sets[0].runs[1].run_times_s = {30, 10, 11};
  const auto comparison = compare_sets(scene, "shadowD6");
  REQUIRE(comparison);
  CHECK(std::abs(comparison->vox_quality - 0.95) < 1e-12);
  CHECK(std::abs(comparison->production_share - 1 / 0.95) < 1e-12);
  CHECK(comparison->full_s == 11);
  CHECK(std::abs(comparison->speed_up() - 220) < 1e-9);
  scene.sets[1].runs[1].run_times_s.clear();
  CHECK_FALSE(compare_sets(scene, "shadowD6"));
}

TEST_CASE("means are over the scenes that have a figure") {
  const PlanningEvaluation evaluation = two_scenes();
  const MethodMeans means = means_of(evaluation, "full", "shadowD6");
  CHECK(means.scenes == 1);
  expect_near(means.vox_ratio, 0.95);
  expect_near(means.run_time_s, 10);
  expect_near(means.true_gain_m3, 8e-4);
  expect_near(means.regret_m3, 1e-4);
  const MethodMeans none = means_of(evaluation, "full", "mesh");
  CHECK(none.scenes == 0);
  CHECK_FALSE(none.vox_ratio);
  CHECK_FALSE(none.run_time_s);
}

TEST_CASE("the mean speed-up is that of all scenes' times together") {
  PlanningEvaluation evaluation{{"voxel", "shadowD6"}, 5, {wall_scene(), wall_scene()}};
  evaluation.scenes[1].sets[0].runs[1].run_times_s = {30};
  const auto mean = mean_comparison(evaluation, "shadowD6");
  REQUIRE(mean);
  CHECK(mean->full_s == 20);
  CHECK(std::abs(mean->speed_up() - 400) < 1e-9);
  CHECK_FALSE(mean_comparison(evaluation, "mesh"));
}

}  // namespace vantage
