#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "reconstruction/voting_scenes.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {
namespace {

const Eigen::Vector3d kCube(0.05, 0.05, 0.05);
const Pose kTurned = Pose::from_rotation(
    Eigen::AngleAxisd(0.4, Eigen::Vector3d(0.2, 0.3, 1).normalized()).toRotationMatrix(),
    {0.03, -0.02, 0.04});

}  // namespace

TEST_CASE("voting: exact corners give exact poses, whatever the boxes' turn") {
  Random random(11);
  const std::vector<ObjectType> boxes{marked_box("cube", kCube, 0),
                                      marked_box("brick", {0.1, 0.06, 0.04}, 10)};
  const MemoryKnowledgeBase knowledge(boxes);
  for (std::uint32_t s = 0; s < scene_count(12); ++s) {
    auto views = cameras_around(random, 4);
    const auto objects = scattered(random, knowledge.types(), 4, 0.15);
    look_at(views, objects, {.sigma_px = 0}, random);
    const Reconstruction result = reconstruct_voting(views, knowledge);
    check_accounts(views, result);
    CHECK(result.objects.size() == objects.size());
    for (const PlacedObject& truth : objects) {
      const auto* found = object_at(result, truth, 0.005);
      REQUIRE(found);
      check_pose(*found, truth.T_world_object, 1e-6, 1e-5);
      CHECK(found->rms_px < 1e-3);
      CHECK(found->covariance);
    }
  }
}

TEST_CASE("voting: instances of one type side by side are told apart") {
  Random random(12);
  const MemoryKnowledgeBase knowledge({marked_box("cube", kCube, 0)});
  for (std::uint32_t s = 0; s < scene_count(8); ++s) {
    auto views = cameras_around(random, 4);
    std::vector<PlacedObject> objects;
    for (int i = 0; i < 9; ++i) {  // three by three, a millimetre apart
      const Eigen::Vector3d place(0.051 * (i % 3 - 1), 0.051 * (i / 3 - 1), 0.025);
      objects.push_back({knowledge.types()[0], Pose::from_translation(place)});
    }
    look_at(views, objects, {.sigma_px = 0.2}, random);
    const Reconstruction result = reconstruct_voting(views, knowledge);
    check_accounts(views, result);
    CHECK(result.objects.size() == objects.size());
    for (const PlacedObject& truth : objects) {
      const auto* found = object_at(result, truth, 0.01);
      REQUIRE(found);
      check_pose(*found, truth.T_world_object, 0.003, 0.06);
      CHECK(found->probability > 0.9);
    }
  }
}

TEST_CASE("voting: where the table's lattice lies in the world makes no difference") {
  Random random(14);
  const MemoryKnowledgeBase knowledge(
      {marked_box("cube", kCube, 0), marked_box("brick", {0.1, 0.06, 0.04}, 10)});
  for (std::uint32_t s = 0; s < scene_count(10); ++s) {
    auto views = cameras_around(random, 4);
    look_at(views, scattered(random, knowledge.types(), 6, 0.2),
            {.sigma_px = 0.3, .missing = 0.1, .wrong_id = 0.05}, random);
    const Reconstruction here = reconstruct_voting(views, knowledge);
    const Pose T_there_here = random.pose(0.5);
    for (CameraView& view : views) view.T_world_cam = T_there_here * *view.T_world_cam;
    const Reconstruction there = reconstruct_voting(views, knowledge);
    REQUIRE(there.objects.size() == here.objects.size());
    for (std::size_t i = 0; i < here.objects.size(); ++i) {
      const ReconstructedObject &a = here.objects[i], &b = there.objects[i];
      REQUIRE(a.type == b.type);
      CHECK(a.support.size() == b.support.size());
      CHECK(std::abs(a.probability - b.probability) < 1e-4);
      check_pose(b, T_there_here * a.T_world_object, 2e-6, 1e-4);
    }
  }
}

TEST_CASE("voting: clutter with missing markers and 5 % wrong ids") {
  Random random(13);
  const MemoryKnowledgeBase knowledge({marked_box("cube", kCube, 0),
                                       marked_box("brick", {0.1, 0.06, 0.04}, 10),
                                       marked_box("slab", {0.08, 0.08, 0.03}, 20)});
  std::size_t there = 0, found = 0, invented = 0;
  for (std::uint32_t s = 0; s < scene_count(20); ++s) {
    auto views = cameras_around(random, 5);
    const auto objects = scattered(random, knowledge.types(), 8, 0.2);
    look_at(views, objects, {.sigma_px = 0.2, .missing = 0.2, .wrong_id = 0.05}, random);
    const Reconstruction result = reconstruct_voting(views, knowledge);
    check_accounts(views, result);
    there += objects.size();
    std::size_t right = 0;
    for (const PlacedObject& truth : objects) right += object_at(result, truth, 0.005) != nullptr;
    found += right;
    invented += result.objects.size() - right;
  }
  MESSAGE(found << " of " << there << " found, " << invented << " invented");
  CHECK(found >= there * 98 / 100);
  CHECK(invented <= there * 3 / 100);
}

TEST_CASE("voting: a marker, a pose, a label and single points together, none of them enough") {
  // The same marker is on two types of two colours; seen from afar, it may be tilted two ways; the
  // points are but two.
  ObjectType red = marked_box("red", kCube, 0, 1), blue = marked_box("blue", kCube, 0, 1);
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
  ObjectType red = marked_box("red", kCube, 0), blue = marked_box("blue", kCube, 0);
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

TEST_CASE("voting: labels somewhere else, and at another part of the object, say nothing for it") {
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
      {marked_box("cube", kCube, 0, 1), marked_box("long box", {0.05, 0.05, 0.05}, 0, 1)});
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
      {marked_box("plain", kCube, 0, 1), marked_box("marked", kCube, 0, 4)});
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
  const MemoryKnowledgeBase two({marked_box("plain", kCube, 0, 1), other});
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
  check_parts(without.unexplained[0].reason, {"against"});
}

TEST_CASE("voting: a single marker from the front may be tilted two ways; more views settle it") {
  Random random(4);
  const MemoryKnowledgeBase knowledge({marked_box("cube", kCube, 0, 1)});
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

TEST_CASE("voting: single points of one camera, some of them wrong") {
  ObjectType type;
  type.name = "thing";
  type.mesh = std::make_shared<const TriangleMesh>(box_solid({0.1, 0.1, 0.1}));
  Random random(5);
  for (int i = 0; i < 9; ++i) {
    type.features.push_back(key_point("point " + std::to_string(i), random.in_cube(0.05)));
  }
  const MemoryKnowledgeBase knowledge({type});
  for (std::uint32_t s = 0; s < scene_count(20); ++s) {
    auto views = aimed({{0.5, 0.2, 0.3}});
    const std::vector<PlacedObject> objects{
        {knowledge.types()[0], Pose::from_rotation(random.pose(0).rotation(), {0.1, 0, 0})},
        {knowledge.types()[0], Pose::from_rotation(random.pose(0).rotation(), {-0.1, 0.05, 0})}};
    for (const PlacedObject& object : objects) {
      for (std::size_t f = 0; f < 9; ++f) see_points(views[0], type, f, object.T_world_object);
    }
    std::swap(views[0].observations[0].key, views[0].observations[5].key);
    const Reconstruction result = reconstruct_voting(views, knowledge);
    check_accounts(views, result);
    CHECK(result.objects.size() == 2);
    CHECK(result.unexplained.size() == 2);
    for (const PlacedObject& truth : objects) {
      const auto* found = object_at(result, truth, 0.01);
      REQUIRE(found);
      check_pose(*found, truth.T_world_object, 1e-5, 1e-4);
    }
  }
}

TEST_CASE("voting: poses of a symmetric type in whatever way a detector turned them are one") {
  ObjectType box;
  box.name = "box";
  box.mesh = std::make_shared<const TriangleMesh>(box_solid({0.1, 0.06, 0.04}));
  box.features.push_back({{"pose", "box"}, FeaturePose{}});
  ObjectType can = box;
  can.name = "can";
  can.mesh = std::make_shared<const TriangleMesh>(cylinder_solid(0.03, 0.1));
  can.features[0].key.value = "can";
  can.symmetries.continuous.push_back({{0, 0, 1}});
  using Eigen::Vector3d;
  const auto half_turn = [](const Vector3d& axis) {
    return Pose::from_rotation(Eigen::AngleAxisd(std::numbers::pi, axis).toRotationMatrix(),
                               Vector3d::Zero());
  };
  for (int i = 0; i < 3; ++i) box.symmetries.discrete.push_back(half_turn(Vector3d::Unit(i)));
  const MemoryKnowledgeBase knowledge({box, can});
  Random random(6);
  for (std::uint32_t s = 0; s < scene_count(20); ++s) {
    auto views = cameras_around(random, 5);
    const Pose box_truth = Pose::from_rotation(random.pose(0).rotation(), {0.1, 0, 0.05});
    const Pose can_truth = Pose::from_rotation(random.pose(0).rotation(), {-0.1, 0, 0.05});
    for (CameraView& view : views) {
      const auto seen = [&](const Pose& pose, const char* name) {
        const Pose noisy =
            moved_by(pose, normal_vector(random, 0.001), normal_vector(random, 0.01));
        view.observations.push_back(
            {{"pose", name}, SeenPose{view.T_world_cam->inverse() * noisy, 0.001, 0.01}});
      };
      const std::uint32_t turn = random.below(4);
      seen(turn == 3 ? box_truth : box_truth * box.symmetries.discrete[turn], "box");
      const Eigen::AngleAxisd spin(random.uniform(-3.1, 3.1), Vector3d::UnitZ());
      seen(can_truth * Pose::from_rotation(spin.toRotationMatrix(), Vector3d::Zero()), "can");
    }
    const Reconstruction result = reconstruct_voting(views, knowledge);
    check_accounts(views, result);
    REQUIRE(result.objects.size() == 2);
    CHECK(result.unexplained.empty());
    CHECK(result.objects[0].alternatives.empty());
    check_pose(result.objects[0], box_truth, 0.003, 0.03);
    const Vector3d axis = result.objects[1].T_world_object.rotation().col(2);
    CHECK(axis.dot(can_truth.rotation().col(2)) > std::cos(0.03));
    CHECK((result.objects[1].T_world_object.translation() - can_truth.translation()).norm() <
          0.003);
  }
}

TEST_CASE("voting: what cannot be used has its reason, and nothing is invented") {
  const ObjectType cube = marked_box("cube", kCube, 0);
  const MemoryKnowledgeBase knowledge({cube});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto views = aimed({{0.5, 0.2, 0.3}, {0.4, -0.3, 0.3}});
  CHECK(reconstruct_voting({}, knowledge).objects.empty());
  CHECK(reconstruct_voting(views, MemoryKnowledgeBase()).objects.empty());
  CHECK(reconstruct_voting(views, knowledge).objects.empty());  // no markers

  const SeenPoints good = pixels_of(views[0], cube.features[0], Pose());
  SeenPoints broken = good, flat = good, gone = good;
  broken.pixels[2].x() = nan;
  for (int i = 0; i < 4; ++i) flat.pixels[std::size_t(i)] = {100.0 + 20 * i, 100};
  for (Eigen::Vector2d& pixel : gone.pixels) pixel = {50, 50};
  const FeatureKey key = cube.features[0].key;
  views[0].observations = {{key, broken},
                           {key, flat},
                           {key, gone},
                           {{"aruco", "4X4/77"}, good},
                           {key, SeenPoints{{{1, 2}}, 0.1}},
                           {key, SeenPose{Pose(), 0.0, 0.1}},
                           {{"color", "red"}, SeenLabel{{0, 0, 1}}}};
  views[1].T_world_cam.reset();
  views[1].observations = {{key, good}};
  const Reconstruction nothing = reconstruct_voting(views, knowledge);
  CHECK(nothing.objects.empty());
  check_accounts(views, nothing);

  views[0].observations = {{key, good}, {key, good}};  // twice the same
  const Reconstruction once = reconstruct_voting(views, knowledge);
  REQUIRE(once.objects.size() == 1);
  CHECK(once.objects[0].support.size() == 1);
  check_accounts(views, once);

  // Far beyond what a table can hold.
  ObjectType far = cube;
  far.features = {{{"pose", "cube"}, FeaturePose{}}};
  views[0].observations = {
      {{"pose", "cube"}, SeenPose{Pose::from_translation({0, 0, 1e9}), 0.001, 0.01}}};
  const Reconstruction lost = reconstruct_voting(views, MemoryKnowledgeBase({far}));
  CHECK(lost.objects.empty());
  check_accounts(views, lost);
}

TEST_CASE("voting: bounds that are none are refused") {
  const MemoryKnowledgeBase knowledge;
  expect_bad_input("options: merge_m", "found 0",
                   [&] { reconstruct_voting({}, knowledge, {.merge_m = 0}); });
  expect_bad_input("options: inlier_px", "expected a positive",
                   [&] { reconstruct_voting({}, knowledge, {.inlier_px = -1}); });
}

TEST_CASE("voting: stops when it is told to, with what it has") {
  Random random(7);
  const MemoryKnowledgeBase knowledge({marked_box("cube", kCube, 0)});
  auto views = cameras_around(random, 3);
  look_at(views, scattered(random, knowledge.types(), 4, 0.15), {}, random);
  const StopToken stop;
  stop.cancel();
  const Reconstruction result = reconstruct_voting(views, knowledge, {}, stop);
  CHECK(result.stopped == StopReason::cancelled);
  CHECK(result.objects.empty());
  check_accounts(views, result);
}

TEST_CASE("voting: the same to the bit at any number of threads") {
  Random random(8);
  const MemoryKnowledgeBase knowledge(
      {marked_box("cube", kCube, 0), marked_box("twin", kCube, 0), marked_box("brick", kCube, 10)});
  auto views = cameras_around(random, 6);
  look_at(views, scattered(random, knowledge.types(), 8, 0.2), {.wrong_id = 0.05}, random);
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return reconstruct_voting(views, knowledge);
  };
  const Reconstruction one = with_threads(1), many = with_threads(4);
  REQUIRE(one.objects.size() == many.objects.size());
  for (std::size_t i = 0; i < one.objects.size(); ++i) {
    const ReconstructedObject &a = one.objects[i], &b = many.objects[i];
    CHECK(a.type == b.type);
    CHECK(a.T_world_object.rotation() == b.T_world_object.rotation());
    CHECK(a.T_world_object.translation() == b.T_world_object.translation());
    CHECK(a.probability == b.probability);
    CHECK(a.support.size() == b.support.size());
    CHECK(a.alternatives.size() == b.alternatives.size());
  }
  CHECK(one.unexplained.size() == many.unexplained.size());
}

}  // namespace vantage::test
