#include <doctest/doctest.h>

#include <cmath>

#include "reconstruction/voting_scenes.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {

TEST_CASE("voting: exact corners give exact poses, whatever the boxes' turn") {
  Random random(11);
  const std::vector<ObjectType> boxes{marked_box("cube", kCubeSize, 0),
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
  const MemoryKnowledgeBase knowledge({marked_box("cube", kCubeSize, 0)});
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

TEST_CASE("voting: as precise as multi-view PnP, also where every marker alone is vague") {
  Random random(15);
  const MemoryKnowledgeBase knowledge({marked_box("cube", kCubeSize, 0),
                                       marked_box("brick", {0.1, 0.06, 0.04}, 10),
                                       marked_box("slab", {0.08, 0.08, 0.03}, 20)});
  const std::uint32_t scenes = scene_count(12);
  double off_m[2] = {0, 0}, off_rad[2] = {0, 0};
  for (std::uint32_t s = 0; s < scenes; ++s) {
    auto views = cameras_around(random, 4);
    const auto objects = scattered(random, knowledge.types(), 6, 0.2);
    look_at(views, objects, {.sigma_px = 1.0}, random);
    const Reconstruction both[] = {reconstruct_voting(views, knowledge),
                                   reconstruct_pnp(views, knowledge)};
    CHECK(both[0].objects.size() == objects.size());
    for (const PlacedObject& truth : objects) {
      for (int method = 0; method < 2; ++method) {
        const auto* found = object_at(both[method], truth, 0.02);
        REQUIRE(found);
        const PoseError error =
            pose_error(*found->type, found->T_world_object, truth.T_world_object);
        off_m[method] += error.m;
        off_rad[method] += error.rad;
      }
    }
  }
  CHECK(off_m[0] < 1.1 * off_m[1]);
  CHECK(off_rad[0] < 1.1 * off_rad[1]);
}

TEST_CASE("voting: where the table's lattice lies in the world makes no difference") {
  Random random(14);
  const MemoryKnowledgeBase knowledge(
      {marked_box("cube", kCubeSize, 0), marked_box("brick", {0.1, 0.06, 0.04}, 10)});
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
  const MemoryKnowledgeBase knowledge({marked_box("cube", kCubeSize, 0),
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

}  // namespace vantage::test
