#include "metrics/reconstruction/bop_scores.hpp"

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "metrics/cube_scene.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"

namespace vantage {
namespace {

constexpr Intrinsics kCubesCamera{160, 120, 150, 150, 79.5, 59.5};

/// Two cubes on a table, and two cameras above that measure depth.
struct MeasuredCubes {
  std::vector<TrueObject> truth{
      {"red", test::cube_type("red"), Pose::from_translation({-0.05, 0, 0.025})},
      {"blue", test::cube_type("blue"), Pose::from_translation({0.05, 0, 0.025})}};
  std::vector<ScoredImage> images;

  MeasuredCubes() {
    SceneBuilder builder;
    builder.add_box(Box({-1, -1, -0.1}, {1, 1, 0}));
    for (const TrueObject& object : truth) {
      builder.add_mesh(object.type->mesh->transformed(object.T_world_object));
    }
    const auto scene = builder.build();
    for (const Eigen::Vector3d& eye : {Eigen::Vector3d(0.1, -0.2, 0.5), {-0.2, 0.2, 0.4}}) {
      const PinholeCamera camera(kCubesCamera, Pose::looking_at(eye, {0, 0, 0.02}));
      images.push_back({kCubesCamera, camera.T_world_cam(),
                        std::make_shared<const DepthImage>(scene->render_depth(camera))});
    }
  }

  Reconstruction shifted(const Eigen::Vector3d& shift) const {
    Reconstruction result;
    for (const TrueObject& object : truth) {
      result.objects.push_back(
          test::estimate(object.type, Pose::from_translation(shift) * object.T_world_object));
    }
    return result;
  }
};

}  // namespace

TEST_CASE("the truth has full marks") {
  const MeasuredCubes scene;
  const auto scores =
      bop_scores(ReconstructionEvaluator(scene.truth), scene.shifted({0, 0, 0}), scene.images);
  REQUIRE(scores);
  CHECK(scores->targets == 4);
  CHECK(scores->average_recall() == 1);
}

TEST_CASE("a shift costs the thresholds that lie below it") {
  const MeasuredCubes scene;
  const double diameter = 0.05 * std::sqrt(3.0);
  const auto scores = bop_scores(ReconstructionEvaluator(scene.truth),
                                 scene.shifted({0, 0, 0.17 * diameter}), scene.images);
  REQUIRE(scores);
  CHECK(scores->ar_mssd == doctest::Approx(0.7));  // 0.2 and above
  CHECK(scores->ar_mspd < 1);
  CHECK(scores->ar_vsd.value() < 1);
  CHECK(scores->ar_vsd.value() > 0.2);
}

TEST_CASE("MSPD's thresholds are pixels of an image that is 640 wide") {
  MeasuredCubes scene;
  scene.images.resize(1);
  scene.images[0].T_world_cam = Pose::looking_at({0, 0, 0.55}, {0, 0, 0});  // 0.5 m above them
  scene.images[0].depth = nullptr;
  // 1 cm sideways: 3 pixels on top, 2.73 at the bottom; thresholds are 1.25, 2.5, 3.75, … pixels.
  const auto scores =
      bop_scores(ReconstructionEvaluator(scene.truth), scene.shifted({0.01, 0, 0}), scene.images);
  REQUIRE(scores);
  CHECK(scores->ar_mspd == doctest::Approx(0.8));
  CHECK_FALSE(scores->ar_vsd);  // no depth
  CHECK_FALSE(scores->average_recall());
}

TEST_CASE("each estimate's errors are those of its object") {
  const MeasuredCubes scene;
  Reconstruction swapped = scene.shifted({0, 0, 0.002});
  std::swap(swapped.objects[0], swapped.objects[1]);
  const auto errors = estimate_errors(ReconstructionEvaluator(scene.truth), swapped);
  REQUIRE(errors.size() == 2);
  CHECK(errors[0].truth == 1);
  CHECK(errors[1].truth == 0);
  for (const EstimateErrors& e : errors) {
    for (const double shift : {e.translation_m, e.add_m, e.add_s_m, e.mssd_m}) {
      CHECK(std::abs(shift - 0.002) < 1e-9);
    }
    CHECK(e.rotation_rad < 1e-9);
  }
}

TEST_CASE("hidden objects are not targets, and finding them changes no score") {
  MeasuredCubes scene;
  for (ScoredImage& image : scene.images) {  // a wall at 10 cm
    image.depth = std::make_shared<const DepthImage>(160, 120, std::vector<float>(160 * 120, 0.1f));
  }
  CHECK_FALSE(
      bop_scores(ReconstructionEvaluator(scene.truth), scene.shifted({0, 0, 0}), scene.images));
}

TEST_CASE("what is not found is missing from every recall") {
  const MeasuredCubes scene;
  Reconstruction one = scene.shifted({0, 0, 0});
  one.objects.pop_back();
  const auto scores = bop_scores(ReconstructionEvaluator(scene.truth), one, scene.images);
  REQUIRE(scores);
  CHECK(scores->average_recall().value() == doctest::Approx(0.5));
  const auto none = bop_scores(ReconstructionEvaluator(scene.truth), {}, scene.images);
  CHECK(none->average_recall() == 0);
  CHECK(estimate_errors(ReconstructionEvaluator(scene.truth), {}).empty());
}

TEST_CASE("scores are the same at any number of threads") {
  const MeasuredCubes scene;
  const ReconstructionEvaluator evaluator(scene.truth);
  const Reconstruction off = scene.shifted({0.004, -0.003, 0.01});
  std::vector<BopScores> all;
  for (const int threads : {1, 3}) {
    tbb::task_arena arena(threads);
    all.push_back(arena.execute([&] { return bop_scores(evaluator, off, scene.images).value(); }));
  }
  CHECK(all[0].ar_vsd == all[1].ar_vsd);
  CHECK(all[0].ar_mspd == all[1].ar_mspd);
}

}  // namespace vantage
