#include <doctest/doctest.h>

#include "reconstruction/synthetic_views.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

// Features of one point each, as learned detectors give them, and measured poses.

using namespace vantage;
using namespace vantage::test;

namespace {

const std::vector<Eigen::Vector3d> kPlaces{{0.05, 0, 0},    {-0.05, 0.01, 0},
                                           {0, 0.04, 0.01}, {0, -0.04, -0.02},
                                           {0.01, 0, 0.04}, {0.02, 0.03, -0.03}};

ObjectType jug() {
  ObjectType type;
  type.name = "jug";
  type.mesh = std::make_shared<const TriangleMesh>(box_solid({0.1, 0.08, 0.08}));
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    type.features.push_back({{"keypoint", std::to_string(i)}, FeaturePoints{{kPlaces[i]}}});
  }
  return type;
}

/// Sees the first `count` points of a jug.
void see(CameraView& view, const Pose& T_world_object, std::size_t count, Random& random) {
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d pixel =
        view.lens.project(view.T_world_cam->inverse() * (T_world_object * kPlaces[i]));
    const Eigen::Vector2d noise(0.3 * normal(random), 0.3 * normal(random));
    view.observations.push_back(
        {{"keypoint", std::to_string(i)}, SeenPoints{{pixel + noise}, 0.3}});
  }
}

double nearest(const Reconstruction& result, const Pose& truth) {
  double least = 1;
  for (const ReconstructedObject& object : result.objects) {
    least = std::min(least, pose_error(*object.type, object.T_world_object, truth).m);
  }
  return least;
}

}  // namespace

TEST_CASE("PnP: single points of one object, seen by several cameras") {
  const MemoryKnowledgeBase knowledge({jug()});
  for (std::uint32_t seed = 1; seed <= scene_count(20); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    auto views = cameras_around(random, 3);
    const Pose truth = random.pose(0.05);
    // Two points alone are of no use to their camera, and of much to the object.
    see(views[0], truth, 6, random);
    see(views[1], truth, 4, random);
    see(views[2], truth, 2, random);
    const Reconstruction result = reconstruct_pnp(views, knowledge);
    REQUIRE(result.objects.size() == 1);
    CHECK(result.objects[0].support.size() == 12);
    CHECK(nearest(result, truth) < 0.004);
  }
}

TEST_CASE("PnP: single points of two objects, one of them off") {
  const MemoryKnowledgeBase knowledge({jug()});
  for (std::uint32_t seed = 1; seed <= scene_count(15); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    auto views = cameras_around(random, 2);
    const Pose left = Pose::from_rotation(random.pose(0).rotation(), {-0.1, 0, 0.05});
    const Pose right = Pose::from_rotation(random.pose(0).rotation(), {0.1, 0, 0.05});
    for (CameraView& view : views) {
      see(view, left, 6, random);
      see(view, right, 6, random);
    }
    std::get<SeenPoints>(views[0].observations[1].data).pixels[0] += Eigen::Vector2d(25, -30);
    const Reconstruction result = reconstruct_pnp(views, knowledge);
    CHECK(result.objects.size() == 2);
    CHECK(nearest(result, left) < 0.01);
    CHECK(nearest(result, right) < 0.01);
    REQUIRE(result.unexplained.size() == 1);
    CHECK(result.unexplained[0].id == ObservationId{0, 1});
    CHECK(result.unexplained[0].reason.find("too few points") != std::string::npos);
  }
}

TEST_CASE("PnP: three single points fit several poses, and make no object") {
  const MemoryKnowledgeBase knowledge({jug()});
  Random random(1);
  auto views = cameras_around(random, 1);
  see(views[0], {}, 3, random);
  const Reconstruction result = reconstruct_pnp(views, knowledge);
  CHECK(result.objects.empty());
  CHECK(result.unexplained.size() == 3);
}

// The object is the same when turned by a third; the detector says any of the three.
TEST_CASE("PnP: measured poses that differ by a symmetry are of one object") {
  ObjectType star = jug();
  star.name = "star";
  star.features = {{{"pose", "star"}, FeaturePose{Pose::from_translation({0.01, 0, 0})}}};
  std::vector<Pose> thirds;
  for (int k = 0; k < 3; ++k) {
    const Eigen::AngleAxisd turn(k * 2.0943951023931953, Eigen::Vector3d::UnitZ());
    thirds.push_back(Pose::from_rotation(turn.toRotationMatrix(), Eigen::Vector3d::Zero()));
  }
  star.symmetries.discrete = {thirds[1], thirds[2]};
  const MemoryKnowledgeBase knowledge({star});
  const Pose frame = Pose::from_translation({0.01, 0, 0});
  for (std::uint32_t seed = 1; seed <= scene_count(20); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    auto views = cameras_around(random, 3);
    const Pose truth = random.pose(0.1);
    for (std::size_t v = 0; v < views.size(); ++v) {
      const Pose noisy = moved_by(truth * thirds[(v + seed) % 3] * frame,
                                  normal_vector(random, 0.002), normal_vector(random, 0.02));
      views[v].observations.push_back(
          {{"pose", "star"}, SeenPose{views[v].T_world_cam->inverse() * noisy, 0.002, 0.02}});
    }
    const Reconstruction result = reconstruct_pnp(views, knowledge);
    REQUIRE(result.objects.size() == 1);
    const ReconstructedObject& found = result.objects[0];
    CHECK(found.support.size() == 3);
    CHECK(found.alternatives.empty());
    CHECK(nearest(result, truth) < 0.006);
    for (const Pose& third : thirds) {
      CHECK(found.T_world_object.rotation().trace() >=
            (found.T_world_object * third).rotation().trace() - 1e-6);
    }
  }
}
