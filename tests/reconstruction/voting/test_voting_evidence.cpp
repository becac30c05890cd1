#include <doctest/doctest.h>

#include <cmath>

#include "reconstruction/voting_scenes.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {
namespace {

const Pose kTurned = Pose::from_rotation(
    Eigen::AngleAxisd(0.4, Eigen::Vector3d(0.2, 0.3, 1).normalized()).toRotationMatrix(),
    {0.03, -0.02, 0.04});

}  // namespace

TEST_CASE("voting: a marker, a pose, a label and single points together, none of them enough") {
  // The same marker is on two types of two colours; seen from afar, it may be tilted two ways; the
  // points are but two.
  ObjectType red = marked_box("red", kCubeSize, 0, 1), blue = marked_box("blue", kCubeSize, 0, 1);
  for (ObjectType* type : {&red, &blue}) {
    type->features.push_back(key_point("dot a", {0.02, 0.025, 0.02}));
    type->features.push_back(key_point("dot b", {-0.02, 0.025, -0.02}));
    type->features.push_back({{"pose", "box"}, FeaturePose{}});
    type->features.push_back(label("color", type->name));
  }
  const MemoryKnowledgeBase knowledge({blue, red});
  const Pose truth = kTurned;
  auto views = aimed({{1.2, 0.5, 0.3}, {0.5, 1.2, 0.3}});
  see_points(views[0], red, 0, truth);
  const auto reds = [&](const Reconstruction& result) {
    std::vector<std::pair<std::string, double>> all;
    for (const ReconstructedObject& object : result.objects) {
      all.emplace_back(object.type->name, object.probability);
      for (const Alternative& other : object.alternatives) {
        all.emplace_back(other.type->name, other.probability);
      }
    }
    return all;
  };
  // A pose that is a little off, the two points from the other side, and red paint on the box.
  see_points(views[1], red, 1, truth);
  see_points(views[1], red, 2, truth);
  const Pose off = moved_by(truth, {0.004, -0.003, 0.003}, {0.03, 0.02, -0.04});
  views[1].observations.push_back(
      {{"pose", "box"}, SeenPose{views[1].T_world_cam->inverse() * off, 0.004, 0.04}});
  const auto undecided = reds(reconstruct_voting(views, knowledge));
  REQUIRE(undecided.size() == 2);
  CHECK(std::abs(undecided[0].second - undecided[1].second) < 1e-9);
  CHECK(undecided[0].second > 0.49);
  see_label(views[1], {"color", "red"}, truth * Eigen::Vector3d(0.0, 0.025, 0.0));

  const Reconstruction result = reconstruct_voting(views, knowledge);
  check_accounts(views, result);
  CHECK(result.unexplained.empty());
  REQUIRE(result.objects.size() == 1);
  CHECK(result.objects[0].type->name == "red");
  CHECK(result.objects[0].support.size() == 5);
  check_pose(result.objects[0], truth, 0.001, 0.01);
}

TEST_CASE("voting: a label decides between types with the same marker") {
  ObjectType red = marked_box("red", kCubeSize, 0), blue = marked_box("blue", kCubeSize, 0);
  red.features.push_back(label("color", "red"));
  blue.features.push_back(label("color", "blue"));
  const MemoryKnowledgeBase knowledge({red, blue});
  for (const bool is_red : {true, false}) {
    auto views = aimed({{0.5, 0.3, 0.4}, {0.4, -0.4, 0.4}});
    look_at(views, {{shared(red), kTurned}}, {.sigma_px = 0}, *std::make_unique<Random>(1));
    const Eigen::Vector3d spot = kTurned * Eigen::Vector3d(0.025, 0.022, 0.022);
    see_label(views[0], {"color", is_red ? "red" : "blue"}, spot);
    see_label(views[1], {"color", is_red ? "red" : "blue"}, spot);
    const Reconstruction result = reconstruct_voting(views, knowledge);
    check_accounts(views, result);
    REQUIRE(result.objects.size() == 1);
    CHECK(result.objects[0].type->name == (is_red ? "red" : "blue"));
    CHECK(result.objects[0].probability > 0.5);
    CHECK(result.objects[0].probability > 1.5 * (1 - result.objects[0].probability));
    CHECK(result.unexplained.empty());
  }
}

TEST_CASE("voting: labels somewhere else, and at another part of the object, do not support it") {
  ObjectType box = marked_box("box", {0.1, 0.1, 0.1}, 0);
  box.features.push_back({{"color", "red"}, FeatureLabel{{{0, 0, 0.05}}, 0.02}});
  const MemoryKnowledgeBase knowledge({box});
  auto views = aimed({{0.5, 0.3, 0.4}, {0.4, -0.4, 0.4}});
  look_at(views, {{shared(box), Pose()}}, {.sigma_px = 0}, *std::make_unique<Random>(1));
  see_label(views[0], {"color", "red"}, {0.01, 0, 0.05});   // where it is
  see_label(views[0], {"color", "red"}, {0.05, 0.0, 0.0});  // on another side
  see_label(views[0], {"color", "red"}, {-0.3, 0.1, 0.0});  // beside the box
  const Reconstruction result = reconstruct_voting(views, knowledge);
  check_accounts(views, result);
  REQUIRE(result.objects.size() == 1);
  const std::size_t count = views[0].observations.size();
  REQUIRE(result.unexplained.size() == 2);
  CHECK(result.unexplained[0].id == ObservationId{0, count - 2});
  CHECK(result.unexplained[1].id == ObservationId{0, count - 1});
  check_parts(result.unexplained[1].reason, {"color red"});
  CHECK(result.objects[0].probability < 1);  // something is where it should not be
}

TEST_CASE("voting: types with the same front are alternatives of the same probability") {
  // Thesis, chapter 6: "a front view of a cube or a long box".
  const MemoryKnowledgeBase knowledge(
      {marked_box("cube", kCubeSize, 0, 1), marked_box("long box", {0.05, 0.05, 0.05}, 0, 1)});
  ObjectType cube = *knowledge.types()[0];
  auto views = aimed({{0.6, 0.2, 0.2}, {0.6, -0.25, 0.2}, {0.6, 0.05, 0.4}});
  look_at(views, {{knowledge.types()[0], Pose()}}, {.sigma_px = 0.1}, *std::make_unique<Random>(2));
  const Reconstruction result = reconstruct_voting(views, knowledge);
  REQUIRE(result.objects.size() == 1);
  const ReconstructedObject& object = result.objects[0];
  CHECK(object.type->name == "cube");
  CHECK(object.probability > 0.499);
  REQUIRE(object.alternatives.size() == 1);
  CHECK(object.alternatives[0].type->name == "long box");
  CHECK(std::abs(object.alternatives[0].probability - object.probability) < 1e-9);
  CHECK(result.unexplained.empty());
}

TEST_CASE("voting: what a type does not carry, where it would have its surface, removes it") {
  // Both have marker 0 in front; marker 1, at its side, is only on one of them.
  const MemoryKnowledgeBase knowledge(
      {marked_box("plain", kCubeSize, 0, 1), marked_box("marked", kCubeSize, 0, 4)});
  auto views = aimed({{0.5, 0.4, 0.3}});
  look_at(views, {{knowledge.types()[1], Pose()}}, {.sigma_px = 0.05},
          *std::make_unique<Random>(3));
  REQUIRE(views[0].observations.size() == 2);
  const Reconstruction result = reconstruct_voting(views, knowledge);
  REQUIRE(result.objects.size() == 1);
  CHECK(result.objects[0].type->name == "marked");
  CHECK(result.objects[0].alternatives.empty());
  CHECK(result.objects[0].probability > 0.99);

  // Labels that nothing carries there make what one marker suggests doubtful, and then remove it.
  ObjectType other = marked_box("other", {0.02, 0.02, 0.02}, 50);
  other.features.push_back(label("color", "green"));
  const MemoryKnowledgeBase two({marked_box("plain", kCubeSize, 0, 1), other});
  auto one = aimed({{0.6, 0.2, 0.2}});
  see_points(one[0], *two.types()[0], 0, Pose());
  const Reconstruction sure = reconstruct_voting(one, two);
  REQUIRE(sure.objects.size() == 1);
  CHECK(sure.objects[0].probability > 0.9);
  see_label(one[0], {"color", "green"}, {0.025, 0.018, 0.018});
  const Reconstruction doubtful = reconstruct_voting(one, two);
  REQUIRE(doubtful.objects.size() == 1);
  CHECK(doubtful.objects[0].probability < 0.55);
  see_label(one[0], {"color", "green"}, {0.025, -0.018, 0.018});
  const Reconstruction without = reconstruct_voting(one, two);
  CHECK(without.objects.empty());
  check_accounts(one, without);
  check_parts(without.unexplained[0].reason, {"contradict"});
}

TEST_CASE(
    "voting: a single marker from the front may be tilted two ways, and more views settle it") {
  Random random(4);
  const MemoryKnowledgeBase knowledge({marked_box("cube", kCubeSize, 0, 1)});
  std::size_t ambiguous = 0, right = 0;
  const std::uint32_t scenes = scene_count(20);
  for (std::uint32_t s = 0; s < scenes; ++s) {
    auto views = aimed({{1.0, 0.25, 0.1}, {0.9, -0.4, 0.3}});
    views[1].observations.clear();
    auto one = std::vector<CameraView>{views[0]};
    look_at(one, {{knowledge.types()[0], Pose()}}, {.sigma_px = 0.2}, random);
    REQUIRE(one[0].observations.size() == 1);
    const Reconstruction single = reconstruct_voting(one, knowledge);
    REQUIRE(single.objects.size() == 1);
    const ReconstructedObject& object = single.objects[0];
    double sum = object.probability;
    bool has_truth = pose_error(*object.type, object.T_world_object, Pose()).rad < 0.35;
    for (const Alternative& other : object.alternatives) {
      CHECK(other.probability <= object.probability);
      sum += other.probability;
      has_truth = has_truth || pose_error(*other.type, other.T_world_object, Pose()).rad < 0.35;
    }
    CHECK(std::abs(sum - 0.95) < 1e-9);  // it may also be a wrong id
    CHECK(has_truth);
    ambiguous += !object.alternatives.empty();
    ReconstructOptions strict;
    strict.keep_ambiguous = false;
    const Reconstruction kept = reconstruct_voting(one, knowledge, strict);
    CHECK(kept.objects.empty() == !object.alternatives.empty());
    if (kept.objects.empty()) check_parts(kept.unexplained[0].reason, {"tilted"});

    look_at(views, {{knowledge.types()[0], Pose()}}, {.sigma_px = 0.2}, random);
    const Reconstruction both = reconstruct_voting(views, knowledge);
    REQUIRE(both.objects.size() == 1);
    right += both.objects[0].alternatives.empty() &&
             pose_error(*object.type, both.objects[0].T_world_object, Pose()).rad < 0.1;
  }
  CHECK(ambiguous >= enough(10));
  CHECK(right == scenes);
}

}  // namespace vantage::test
