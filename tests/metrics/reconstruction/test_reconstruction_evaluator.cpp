#include "metrics/reconstruction/reconstruction_evaluator.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "metrics/cube_scene.hpp"
#include "support/expect_error.hpp"

namespace vantage {
namespace {

using test::cube_type;
using test::estimate;

Pose at(double x, double y, double z = 0) {
  return Pose::from_translation({x, y, z});
}

/// Two red cubes, and a blue one that touches the first.
std::vector<TrueObject> scene() {
  const TypePtr red = cube_type("red"), blue = cube_type("blue");
  return {{"red 1", red, at(0, 0)}, {"red 2", red, at(0.2, 0)}, {"blue", blue, at(0, 0.05)}};
}

const std::vector<bool> kAll{true, true, true};

}  // namespace

TEST_CASE("the truth itself is without fault") {
  const ReconstructionEvaluator evaluator(scene());
  Reconstruction perfect;
  for (const TrueObject& object : evaluator.truth()) {
    perfect.objects.push_back(estimate(object.type, object.T_world_object));
  }
  const ReconstructionScore score = evaluator.evaluator(perfect, kAll);
  CHECK(score.true_objects == 3);
  CHECK(score.found == 3);
  CHECK(score.correct == 3);
  CHECK(score.found_at == std::vector<std::size_t>(10, 3));
  for (const ObjectErrors& object : score.objects) CHECK(object.mssd_m == 0);
  REQUIRE(score.self_consistency_mm2);
  CHECK(*score.self_consistency_mm2 < 1e-6);
}

TEST_CASE("types are not mixed up, and each instance is used once") {
  const ReconstructionEvaluator evaluator(scene());
  const TypePtr red = evaluator.truth()[0].type, blue = evaluator.truth()[2].type;
  const Reconstruction three{
      {estimate(red, at(0.201, 0)), estimate(red, at(0.199, 0)), estimate(blue, at(0, 0))}, {}};
  const ReconstructionScore score = evaluator.evaluator(three, kAll);
  CHECK(score.estimates == 3);
  CHECK(score.found == 1);    // 8.66 mm is 10 % of the diameter: the second red one is far off
  CHECK(score.correct == 1);  // and the blue one is 5 cm off
  REQUIRE(score.objects.size() == 3);  // errors are of everything
  CHECK(score.objects[0].truth == 1);
  CHECK(score.objects[0].translation_m == doctest::Approx(0.001));
  CHECK(score.objects[1].truth == 0);
  CHECK(score.objects[1].mssd_m == doctest::Approx(0.199));
  CHECK(score.objects[2].translation_m == doctest::Approx(0.05));
}

TEST_CASE("correct is what lies below the threshold, and BOP's ten thresholds are looked at, too") {
  const Reconstruction off{{estimate(cube_type("blue"), at(0, 0.05 + 0.02))}, {}};
  const double share = 0.02 / (0.05 * std::sqrt(3.0));  // 0.23
  for (const bool enough : {true, false}) {
    const ReconstructionEvaluator evaluator(scene(), enough ? share + 0.01 : share - 0.01);
    CHECK(evaluator.evaluator(off, kAll).found == (enough ? 1 : 0));
  }
  const auto found_at = ReconstructionEvaluator(scene()).evaluator(off, kAll).found_at;
  CHECK(found_at == std::vector<std::size_t>{0, 0, 0, 0, 1, 1, 1, 1, 1, 1});
}

TEST_CASE("objects that need not be found do no harm if they are") {
  const ReconstructionEvaluator evaluator(scene());
  const Reconstruction one{{estimate(cube_type("blue"), at(0, 0.05))}, {}};
  const ReconstructionScore score = evaluator.evaluator(one, {true, true, false});
  CHECK(score.true_objects == 2);
  CHECK(score.found == 0);
  CHECK(score.correct == 1);
}

TEST_CASE("an object's symmetry is taken out of rotation and self-consistency") {
  std::vector<TrueObject> truth = scene();
  truth[0].type = truth[1].type = cube_type("red", test::quarter_turns());
  const ReconstructionEvaluator evaluator(truth);
  const Pose turned = at(0, 0) * truth[0].type->symmetries.discrete[0];
  const Reconstruction reconstruction{
      {estimate(truth[0].type, turned), estimate(truth[2].type, at(0, 0.05))}, {}};
  const ReconstructionScore score = evaluator.evaluator(reconstruction, kAll);
  REQUIRE(score.objects.size() == 2);
  CHECK(score.objects[0].rotation_rad < 1e-9);
  REQUIRE(score.self_consistency_mm2);  // red 2 touches nothing: it may be missing
  CHECK(*score.self_consistency_mm2 < 1e-6);
}

TEST_CASE("no self-consistency without every object that touches, or where none does") {
  const ReconstructionEvaluator evaluator(scene());
  const Reconstruction one{{estimate(cube_type("blue"), at(0, 0.05))}, {}};
  CHECK_FALSE(evaluator.evaluator(one, kAll).self_consistency_mm2);
  std::vector<TrueObject> apart = scene();
  apart.pop_back();
  const ReconstructionEvaluator alone(apart);
  const Reconstruction red{{estimate(cube_type("red"), at(0, 0))}, {}};
  CHECK_FALSE(alone.evaluator(red, {true, true}).self_consistency_mm2);
}

TEST_CASE("an empty reconstruction has no error, but finds nothing") {
  const ReconstructionScore score = ReconstructionEvaluator(scene()).evaluator({}, kAll);
  CHECK(score.estimates == 0);
  CHECK(score.found == 0);
  CHECK(score.objects.empty());
}

TEST_CASE("a judge that finds nothing correct is refused") {
  test::expect_bad_input("correct", "found 0", [] { ReconstructionEvaluator({}, 0); });
}

}  // namespace vantage
