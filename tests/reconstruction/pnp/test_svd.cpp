#include <doctest/doctest.h>

#include "reconstruction/synthetic_views.hpp"
#include "support/scene_count.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

MemoryKnowledgeBase one_box() {
  return MemoryKnowledgeBase({marked_box("box", {0.06, 0.05, 0.04}, 0)});
}

std::string only_reason(const Reconstruction& result) {
  REQUIRE(result.objects.empty());
  REQUIRE(result.unexplained.size() == 1);
  return result.unexplained.front().reason;
}

}  // namespace

TEST_CASE("SVD: exact corners give the exact pose") {
  for (std::uint32_t seed = 1; seed <= scene_count(30); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const MemoryKnowledgeBase knowledge = one_box();
    auto views = cameras_around(random, 3);
    const auto objects = scattered(random, knowledge.types(), 1, 0.1);
    look_at(views, objects, {.sigma_px = 0}, random);
    const Reconstruction result = reconstruct_svd(views, knowledge);
    REQUIRE(result.objects.size() == 1);
    CHECK(result.unexplained.empty());
    const ReconstructedObject& found = result.objects.front();
    CHECK(found.type == objects.front().type);
    const PoseError error =
        pose_error(*found.type, found.T_world_object, objects[0].T_world_object);
    CHECK(error.m < 1e-6);
    CHECK(error.rad < 1e-5);
    CHECK(found.rms_px < 1e-3);
    CHECK_FALSE(found.covariance.has_value());
    std::size_t seen = 0;
    for (const CameraView& view : views) seen += view.observations.size();
    CHECK(found.support.size() == seen);
  }
}

// One marker's corners lie in a plane: half of all noise makes det(V Uᵀ) negative.
TEST_CASE("SVD: noisy corners of one marker never come out as a mirror image") {
  const MemoryKnowledgeBase knowledge({marked_box("tile", {0.08, 0.08, 0.01}, 0, 6, 0.9)});
  std::size_t found = 0;
  for (std::uint32_t seed = 1; seed <= scene_count(60); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    auto views = cameras_around(random, 2);
    const PlacedObject tile{knowledge.types()[0], Pose::from_translation({0.01, 0.02, 0.005})};
    look_at(views, {tile}, {.sigma_px = 0.1}, random);
    const Reconstruction result = reconstruct_svd(views, knowledge);
    if (result.objects.empty()) continue;
    ++found;
    const Pose& pose = result.objects.front().T_world_object;
    CHECK(pose.rotation().determinant() == doctest::Approx(1));
    CHECK(pose_error(*tile.type, pose, tile.T_world_object).m < 0.02);
  }
  CHECK(found >= enough(50));
}

TEST_CASE("SVD: several instances of a type become one, as the thesis says") {
  Random random(7);
  const MemoryKnowledgeBase knowledge = one_box();
  auto views = cameras_around(random, 4);
  const auto objects = scattered(random, knowledge.types(), 3, 0.15);
  look_at(views, objects, {}, random);
  CHECK(reconstruct_svd(views, knowledge).objects.size() == 1);
}

TEST_CASE("SVD: what it cannot use has a reason") {
  Random random(3);
  auto views = cameras_around(random, 1);
  SUBCASE("points on a line") {
    ObjectType rod = marked_box("rod", {0.2, 0.01, 0.01}, 0, 0);
    FeaturePoints line;
    SeenPoints seen;
    for (int i = 0; i < 5; ++i) {
      line.points_m.emplace_back(0.04 * i - 0.08, 0, 0);
      seen.pixels.push_back(
          views[0].lens.project(views[0].T_world_cam->inverse() * line.points_m.back()));
    }
    rod.features.push_back({{"keypoint", "line"}, line});
    views[0].observations.push_back({{"keypoint", "line"}, seen});
    const MemoryKnowledgeBase knowledge({rod});
    CHECK(only_reason(reconstruct_svd(views, knowledge)).find("collinear") != std::string::npos);
  }
  SUBCASE("a marker of two types") {
    const MemoryKnowledgeBase knowledge(
        {marked_box("a", {0.05, 0.05, 0.05}, 0, 1), marked_box("b", {0.05, 0.05, 0.09}, 0, 1)});
    const Pose facing = Pose::from_rotation(
        Eigen::AngleAxisd(-1.5707963267948966, Eigen::Vector3d::UnitY()).toRotationMatrix(),
        Eigen::Vector3d::Zero());
    look_at(views, {{knowledge.types()[0], facing}}, {}, random);
    CHECK(only_reason(reconstruct_svd(views, knowledge)).find("2 places") != std::string::npos);
  }
  SUBCASE("a measured pose") {
    const MemoryKnowledgeBase knowledge = one_box();
    views[0].observations.push_back(
        {knowledge.types()[0]->features[0].key, SeenPose{Pose::from_translation({0, 0, 0.5})}});
    CHECK(only_reason(reconstruct_svd(views, knowledge)).find("points only") != std::string::npos);
  }
}

TEST_CASE("SVD: a cancelled run says so, and lists what it did not process") {
  Random random(5);
  const MemoryKnowledgeBase knowledge = one_box();
  auto views = cameras_around(random, 2);
  look_at(views, scattered(random, knowledge.types(), 1, 0.1), {}, random);
  const StopToken stop;
  stop.cancel();
  const Reconstruction result = reconstruct_svd(views, knowledge, {}, stop);
  CHECK(result.stopped == StopReason::cancelled);
  CHECK(result.objects.empty());
  REQUIRE_FALSE(result.unexplained.empty());
  CHECK(result.unexplained[0].reason.find("stopped") != std::string::npos);
}
