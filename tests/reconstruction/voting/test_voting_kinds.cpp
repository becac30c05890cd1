#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "reconstruction/voting_scenes.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {

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

}  // namespace vantage::test
