#include "metrics/reconstruction/subset_evaluation.hpp"

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include "metrics/cube_scene.hpp"
#include "metrics/plot/run_summary.hpp"
#include "metrics/reconstruction/seen_objects.hpp"

namespace vantage {
namespace {

using test::cube_type;

/// A red and a blue cube; the first camera sees both, the second red, the third blue.
struct TwoCubes {
  std::vector<TrueObject> truth{{"red", cube_type("red"), Pose::from_translation({-0.05, 0, 0})},
                                {"blue", cube_type("blue"), Pose::from_translation({0.05, 0, 0})}};
  std::vector<CameraView> views{test::view_of_marks({0, -0.2, 0.7}, truth),
                                test::view_of_marks({0.3, 0, 0.7}, {truth[0]}),
                                test::view_of_marks({0, 0.3, 0.7}, {truth[1]})};
};

/// Puts each object that is named by a key where it truly is, but off by 1 mm for each camera that
/// is missing of three.
EvaluatedMethod pretender(const TwoCubes& scene) {
  return {"pretender", [&scene](std::span<const CameraView> views) {
            Reconstruction result;
            for (const TrueObject& object : scene.truth) {
              for (const CameraView& view : views) {
                bool seen = false;
                for (const Observation& o : view.observations) {
                  seen = seen || o.key == object.type->features[0].key;
                }
                if (!seen) continue;
                const Eigen::Vector3d off(0, 0, 0.001 * double(3 - views.size()));
                result.objects.push_back(test::estimate(
                    object.type, Pose::from_translation(off) * object.T_world_object));
                break;
              }
            }
            return result;
          }};
}

std::vector<SubsetRun> run(const TwoCubes& scene, const SubsetPlan& plan,
                           const StopToken& stop = {}) {
  const ReconstructionEvaluator evaluator(scene.truth);
  const EvaluatedMethod method = pretender(scene);
  return evaluate_subsets(scene.views, evaluator, std::span(&method, 1), plan, stop);
}

}  // namespace

TEST_CASE("an object is seen where its feature is where it has to be") {
  const TwoCubes scene;
  const auto seen = seen_objects(scene.views, scene.truth);
  CHECK(seen == std::vector<std::vector<bool>>{{true, true}, {true, false}, {false, true}});
  CHECK(seen_by(seen, CameraSubset{1, 2}) == std::vector<bool>{true, true});

  std::vector<CameraView> views = scene.views;
  std::get<SeenPoints>(views[1].observations[0].data).pixels[2].x() += 6;  // somewhere else
  views[2].T_world_cam.reset();
  const auto fewer = seen_objects(views, scene.truth);
  CHECK(fewer == std::vector<std::vector<bool>>{{true, true}, {false, false}, {false, false}});
}

TEST_CASE("instances of a type are told apart by where their features are") {
  const TypePtr red = cube_type("red");
  const std::vector<TrueObject> truth{{"1", red, Pose::from_translation({-0.05, 0, 0})},
                                      {"2", red, Pose::from_translation({0.05, 0, 0})}};
  const std::vector<CameraView> views{test::view_of_marks({0, 0, 0.7}, {truth[1]})};
  CHECK(seen_objects(views, truth) == std::vector<std::vector<bool>>{{false, true}});
}

TEST_CASE("subsets that see every object that all cameras see") {
  const TwoCubes scene;
  const auto covering = covering_subsets(scene.views, scene.truth, camera_subsets(3, 1, 3));
  CHECK(covering == std::vector<CameraSubset>{{0}, {0, 1}, {0, 2}, {1, 2}, {0, 1, 2}});
}

TEST_CASE("every subset in every trial, in order, with errors by the number of cameras") {
  const TwoCubes scene;
  const auto runs = run(scene, {.subsets = camera_subsets(3, 1, 3), .trials = 2});
  REQUIRE(runs.size() == 14);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    CHECK(runs[i].subset == i / 2);
    CHECK(runs[i].trial == i % 2);
  }
  const ReconstructionScore& second_alone = runs[2].scores[0];
  CHECK(second_alone.true_objects == 1);  // blue cannot be found
  CHECK(second_alone.found == 1);
  CHECK(second_alone.objects[0].translation_m == doctest::Approx(0.002));
  CHECK(runs[13].scores[0].objects[1].translation_m < 1e-12);
}

TEST_CASE("what is lost cannot be found, and what is ignored is not seen by the method") {
  const TwoCubes scene;
  const auto lost = run(scene, {.subsets = {{0, 1, 2}}, .perturbation = {.drop = 1}});
  CHECK(lost[0].scores[0].true_objects == 2);  // the cameras saw them
  CHECK(lost[0].scores[0].estimates == 0);
  const auto ignored = run(scene, {.subsets = {{0, 1, 2}}, .ignored = {{"mark", "red"}}});
  CHECK(ignored[0].scores[0].estimates == 1);
}

TEST_CASE("subsets have the same scores at any number of threads") {
  const TwoCubes scene;
  const SubsetPlan plan{.subsets = camera_subsets(3, 1, 3),
                        .perturbation = {.drop = 0.4, .wrong_ids = 0.3},
                        .trials = 20,
                        .keys = {{"mark", "red"}, {"mark", "blue"}}};
  std::vector<std::vector<SubsetRun>> all;
  for (const int threads : {1, 3}) {
    tbb::task_arena arena(threads);
    all.push_back(arena.execute([&] { return run(scene, plan); }));
  }
  REQUIRE(all[0].size() == 140);
  std::size_t found = 0;
  for (std::size_t i = 0; i < 140; ++i) {
    CHECK(all[0][i].subset == all[1][i].subset);
    CHECK(all[0][i].scores[0].found == all[1][i].scores[0].found);
    CHECK(all[0][i].scores[0].estimates == all[1][i].scores[0].estimates);
    found += all[0][i].scores[0].found;
  }
  CHECK(found > 50);
  CHECK(found < 240);
}

TEST_CASE("progress is reported, and a cancelled evaluation stops") {
  const TwoCubes scene;
  const StopToken stop;
  const auto runs = run(scene, {.subsets = camera_subsets(3, 1, 3)}, stop);
  CHECK(runs.size() == 7);
  CHECK(stop.progress() == 1);
  const StopToken cancelled;
  cancelled.cancel();
  CHECK(run(scene, {.subsets = {{0}}}, cancelled)[0].scores.empty());
}

TEST_CASE("mean, deviation, median and largest") {
  CHECK_FALSE(spread_of({}));
  const Spread spread = spread_of({4, 1, 2, 9}).value();
  CHECK(spread.count == 4);
  CHECK(spread.mean == doctest::Approx(4));
  CHECK(spread.deviation == doctest::Approx(std::sqrt((0.0 + 9 + 4 + 25) / 3)));
  CHECK(spread.median == doctest::Approx(3));
  CHECK(spread.largest == 9);
  CHECK(spread_of({5}).value().deviation == 0);
  CHECK(spread_of({0.1, 0.1, 0.1}).value().deviation == 0);
}

TEST_CASE("summaries count over runs and average over their means") {
  SubsetRun a{
      0, 0, {ReconstructionScore{.true_objects = 2, .estimates = 3, .found = 1, .correct = 2}}};
  a.scores[0].found_at = {0, 2};
  a.scores[0].objects = {{0, 0, 0.002, 0.1, 0.004}, {1, 1, 0.004, 0.3, 0.008}};
  a.scores[0].self_consistency_mm2 = 7;
  SubsetRun b{1, 0, {ReconstructionScore{.true_objects = 2, .estimates = 0}}};
  b.scores[0].found_at = {0, 0};
  const std::vector<const SubsetRun*> runs{&a, &b};
  const RunSummary summary = summary_of(runs, 0);
  CHECK(summary.runs == 2);
  CHECK(summary.translation_m.value().count == 1);
  CHECK(summary.translation_m->mean == doctest::Approx(0.003));
  CHECK(summary.rotation_rad->mean == doctest::Approx(0.2));
  CHECK(summary.mssd_m->mean == doctest::Approx(0.006));
  CHECK(summary.self_consistency_mm2->mean == 7);
  CHECK(summary.recall == 0.25);
  CHECK(summary.precision.value() == doctest::Approx(2.0 / 3));
  CHECK(summary.average_recall == 0.25);
  CHECK_FALSE(summary_of({}, 0).recall);
}

}  // namespace vantage
