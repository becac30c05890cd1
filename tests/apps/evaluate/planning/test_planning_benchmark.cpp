#include "evaluate/planning/planning_benchmark.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "simulator/scene/ground_truth.hpp"
#include "support/test_data.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::test {
namespace {

/// A post and a crate in a corner, seen from one side; the crate is foreign.
PlanningCell small_cell(const TemporaryFolder& folder, const std::string& depth) {
  const auto file = folder.write(
      "small.yaml",
      "work_area: {min_m: [-0.2, -0.2, 0], max_m: [0.2, 0.2, 0.2]}\n"
      "voxel_size_m: 0.02\n"
      "known_objects:\n"
      "  - {name: post, shape: {box: {size_m: [0.06, 0.06, 0.15]}}, pose: {translation_m: [-0.1, "
      "0, 0.075]}}\n"
      "foreign_objects:\n"
      "  - {name: crate, shape: {box: {size_m: [0.08, 0.08, 0.12]}}, pose: {translation_m: [0.1, "
      "0.05, 0.06]}}\n"
      "cameras: [{name: front, eye_m: [0, -0.7, 0.4], target_m: [0, 0, 0.05]}]\n");
  return load_planning_cell(planning_cell_name(file.string() + depth), DepthKind::none, 0);
}

PlanningBenchmarkOptions small_settings(int servo) {
  PlanningBenchmarkOptions settings;
  choose({"shadowD0", "light"}, {"production"}, settings);
  settings.servo = {.iterations = servo, .image_width = 40};
  settings.polish = {.views = 0};
  return settings;
}

SceneEvaluation evaluate(const PlanningCell& cell, const PlanningBenchmarkOptions& settings) {
  return evaluate_planning(cell, settings, {}).scene;
}

void expect_same(const Pick& a, const Pick& b) {
  CHECK(a.id == b.id);
  CHECK(a.best_step == b.best_step);
  REQUIRE(a.steps.size() == b.steps.size());
  for (std::size_t i = 0; i < a.steps.size(); ++i) {
    CHECK(a.steps[i].worth.method_score == b.steps[i].worth.method_score);
    CHECK(a.steps[i].worth.true_gain_m3 == b.steps[i].worth.true_gain_m3);
  }
}

}  // namespace

TEST_CASE("methods are found by name, with their depth power") {
  CHECK(named_method("voxel").method == Method(VoxelMethod{}));
  CHECK(named_method("shadow").name == "shadowD6");
  const NamedMethod d3 = named_method("shadowD3");
  CHECK(d3.method == Method(ShadowMethod{3}));
  CHECK(named_method("shadowD2.50").name == "shadowD2.5");
  CHECK(named_method("mesh").name == "mesh");
  CHECK(named_method("meshD2").method ==
        Method(MeshMethod{.weight = MeshWeight::depth, .depth_power = 2}));
  CHECK(named_method("mesh").method == Method(MeshMethod{}));
  for (const char* name :
       {"", "shadowD", "shadowDx", "shadowD17", "shadowD-1", "meshD", "lightD3", "Voxel"}) {
    CAPTURE(name);
    CHECK_THROWS_WITH_AS(
        named_method(name),
        (std::string("--methods: found '") + name +
         "'; expected one of: expected, voxel, shadow, mesh, light; or shadowD or meshD "
         "with a depth power from 0 to 16, e.g. shadowD6")
            .c_str(),
        Error);
  }
}

TEST_CASE("voxel is always there and first, as is the full set") {
  PlanningBenchmarkOptions settings;
  choose({"light", "shadowD6"}, {"production", "full"}, settings);
  REQUIRE(settings.methods.size() == 3);
  CHECK(settings.methods[0].name == "voxel");
  CHECK(settings.methods[1].name == "light");
  CHECK(settings.sets == std::vector<std::string>{"full", "production"});
  CHECK_THROWS_WITH_AS(choose({"shadow", "shadowD6"}, {"full"}, settings),
                       "--methods: found shadowD6 twice; name it once", Error);
  CHECK_THROWS_WITH_AS(choose({"voxel"}, {"full", "full"}, settings),
                       "--candidates: found full twice; name it once", Error);
}

TEST_CASE("without servo, picks, true gains and regrets are those of plain counting") {
  const TemporaryFolder folder;
  const PlanningCell cell = small_cell(folder, "+ideal");
  const SceneEvaluation scene = evaluate(cell, small_settings(0));
  const SetEvaluation& set = scene.sets.at(0);
  CHECK(set.views == 40);
  const auto geometry = GridGeometry::covering(cell.request.work_area, cell.request.voxel_size_m);
  const GroundTruth truth(cell.scene, cell.cameras(), geometry);
  CHECK(scene.truly_hidden_m3 == truth.grid().volume_m3(VoxelState::shadow));
  double best = 0;
  HalfSpheres views = production_views();
  views.radii_m = set.radii_m;
  for (const ViewCandidate& view : view_candidates(views, cell.request.work_area)) {
    const PinholeCamera camera(cell.request.intrinsics, view.T_world_cam, cell.request.range);
    best = std::max(best, truth.gain_m3(camera));
    for (const MethodRun& run : set.runs) {
      if (run.pick->id != view.id) continue;
      CHECK(std::abs(run.pick->worth().true_gain_m3 - truth.gain_m3(camera)) < 1e-15);
    }
  }
  CHECK(set.feasible == 40);
  CHECK(std::abs(set.best_true_gain_m3 - best) < 1e-12);
}

TEST_CASE("with servo: no method beats the voxel method by vox score, or the truth's best") {
  const TemporaryFolder folder;
  for (const char* depth : {"+none", "+ideal", "+noisy"}) {
    CAPTURE(depth);
    const SceneEvaluation scene = evaluate(small_cell(folder, depth), small_settings(2));
    REQUIRE(scene.sets.size() == 1);
    REQUIRE(scene.sets[0].runs.size() == 3);
    CHECK(scene.classify_s.size() == 1);
    for (const MethodRun& run : scene.sets[0].runs) {
      CAPTURE(run.method);
      REQUIRE(run.pick);
      CHECK(run.run_times_s.size() == 1);
      CHECK(run.pick->steps.front().move == "start");
      CHECK(run.pick->worth().method_score > 0);
      for (const PickStep& step : run.pick->steps) {
        CHECK(step.worth.method_score <= run.pick->worth().method_score);
      }
      CHECK(*vox_ratio(scene, run.pick->worth()) <= 1 + 1e-12);
      CHECK(*regret_m3(scene.sets[0], run) > -1e-12);
    }
    CHECK(*vox_ratio(scene, scene.sets[0].runs[0].pick->worth()) == 1);
  }
}

TEST_CASE("a polished pick is the last of its steps, and better by its method than the others") {
  const TemporaryFolder folder;
  const PlanningCell cell = small_cell(folder, "+ideal");
  PlanningBenchmarkOptions settings = small_settings(2);
  const SceneEvaluation before = evaluate(cell, settings);
  settings.polish = {.views = 2};
  const SceneEvaluation scene = evaluate(cell, settings);
  std::size_t polished = 0;
  for (std::size_t m = 0; m < scene.sets[0].runs.size(); ++m) {
    const MethodRun& run = scene.sets[0].runs[m];
    CAPTURE(run.method);
    REQUIRE(run.pick);
    CHECK(run.pick->worth().method_score >= before.sets[0].runs[m].pick->worth().method_score);
    CHECK(*regret_m3(scene.sets[0], run) >= 0);
    if (run.pick->steps.back().move != "polish") continue;
    ++polished;
    CHECK(run.pick->best_step + 1 == run.pick->steps.size());
    for (std::size_t i = 0; i < run.pick->best_step; ++i) {
      CHECK(run.pick->steps[i].worth.method_score < run.pick->worth().method_score);
    }
  }
  CHECK(polished >= 2);
  CHECK(scene.sets[0].best_true_gain_m3 >= before.sets[0].best_true_gain_m3);
}

TEST_CASE("a scene in which nothing known hides anything gets no view from voxel and shadow") {
  const TemporaryFolder folder;
  const auto file =
      folder.write("open.yaml",
                   "work_area: {min_m: [-0.1, -0.1, 0.0], max_m: [0.1, 0.1, 0.1]}\n"
                   "voxel_size_m: 0.02\n"
                   "foreign_objects: [{name: a, shape: {box: {size_m: [0.05, 0.05, 0.05]}}, pose: "
                   "{translation_m: [0, 0, 0.025]}}]\n"
                   "cameras: [{name: front, eye_m: [0, -0.7, 0.4], target_m: [0, 0, 0.05]}]\n");
  const PlanningCell cell =
      load_planning_cell(planning_cell_name(file.string()), DepthKind::none, 0);
  const SceneEvaluation scene = evaluate(cell, small_settings(1));
  CHECK(scene.shadow_voxels == 0);
  CHECK(scene.truly_hidden_m3 > 0);
  for (const MethodRun& run : scene.sets[0].runs) CHECK_FALSE(run.pick);
  CHECK(scene.sets[0].best_true_gain_m3 > 0);
}

TEST_CASE("another voxel size, and everything timed several times: the same picks each time") {
  const TemporaryFolder folder;
  const PlanningCell cell = small_cell(folder, "");
  PlanningBenchmarkOptions settings = small_settings(1);
  settings.given["voxel_size_m"] = 0.04;
  settings.repeat = 3;
  const SceneEvaluation scene = evaluate(cell, settings), again = evaluate(cell, settings);
  CHECK(scene.voxel_size_m == 0.04);
  CHECK(scene.free_voxels + scene.occupied_voxels + scene.shadow_voxels == 10 * 10 * 5);
  CHECK(scene.classify_s.size() == 3);
  for (std::size_t i = 0; i < scene.sets[0].runs.size(); ++i) {
    CHECK(scene.sets[0].runs[i].run_times_s.size() == 3);
    expect_same(*scene.sets[0].runs[i].pick, *again.sets[0].runs[i].pick);
  }
}

TEST_CASE("an evaluation that is cancelled ends") {
  const TemporaryFolder folder;
  const StopToken stop;
  stop.cancel();
  CHECK(evaluate_planning(small_cell(folder, ""), small_settings(1), stop).scene.sets.empty());
}

}  // namespace vantage::test
