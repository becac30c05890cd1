#include <doctest/doctest.h>

#include <numbers>

#include "reconstruction/synthetic_views.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

Pose turned(const Eigen::Vector3d& axis, double angle, const Eigen::Vector3d& place = {0, 0, 0}) {
  return Pose::from_rotation(Eigen::AngleAxisd(angle, axis).toRotationMatrix(), place);
}

/// A tile with one marker on its upper side.
ObjectType tile(const std::string& name, double height, int id) {
  ObjectType type;
  type.name = name;
  type.mesh = std::make_shared<const TriangleMesh>(box_solid({0.04, 0.04, height}));
  type.features.push_back(
      marker_feature({"4X4_250", id, 0.03, Pose::from_translation({0, 0, height / 2})}));
  return type;
}

/// One camera that looks at the origin.
std::vector<CameraView> one_camera(const Eigen::Vector3d& eye) {
  Random random(1);
  auto views = cameras_around(random, 1);
  views[0].T_world_cam = Pose::looking_at(eye, {0, 0, 0});
  return views;
}

double sum_of(const ReconstructedObject& object) {
  double sum = object.probability;
  for (const Alternative& other : object.alternatives) sum += other.probability;
  return sum;
}

}  // namespace

TEST_CASE("PnP: a single marker far away is kept with its flip, or left out") {
  const MemoryKnowledgeBase knowledge({tile("tile", 0.01, 0)});
  const Pose truth = turned(Eigen::Vector3d::UnitX(), 0.3);
  int flipped = 0;
  for (std::uint32_t seed = 1; seed <= scene_count(40); ++seed) {
    CAPTURE(seed);
    auto views = one_camera({0, -0.1, 0.8});
    Random random(seed);
    look_at(views, {{knowledge.types()[0], truth}}, {.sigma_px = 0.2}, random);
    REQUIRE(views[0].observations.size() == 1);
    const Reconstruction kept = reconstruct_pnp(views, knowledge);
    REQUIRE(kept.objects.size() == 1);
    const ReconstructedObject& found = kept.objects[0];
    CHECK(sum_of(found) == doctest::Approx(0.95).epsilon(0.001));
    CHECK(found.probability > 0);
    ReconstructOptions strict;
    strict.keep_ambiguous = false;
    const Reconstruction left = reconstruct_pnp(views, knowledge, strict);
    CHECK(left.objects.size() == (found.alternatives.empty() ? 1 : 0));
    if (found.alternatives.empty()) continue;
    ++flipped;
    REQUIRE(left.unexplained.size() == 1);
    CHECK(left.unexplained[0].reason.find("in one view allows") != std::string::npos);
    // One of the two is the truth.
    const double here = pose_error(*found.type, found.T_world_object, truth).rad;
    const double there = pose_error(*found.type, found.alternatives[0].T_world_object, truth).rad;
    CHECK(std::min(here, there) < 0.25);
    CHECK(std::max(here, there) > 0.25);
    CHECK(found.probability >= found.alternatives[0].probability);
  }
  CHECK(flipped >= int(enough(20)));
}

TEST_CASE("PnP: a marker close by has one pose only") {
  const MemoryKnowledgeBase knowledge({tile("tile", 0.01, 0)});
  auto views = one_camera({0.1, -0.2, 0.25});
  Random random(3);
  look_at(views, {{knowledge.types()[0], {}}}, {.sigma_px = 0.1}, random);
  ReconstructOptions strict;
  strict.keep_ambiguous = false;
  const Reconstruction result = reconstruct_pnp(views, knowledge, strict);
  REQUIRE(result.objects.size() == 1);
  CHECK(result.objects[0].alternatives.empty());
  CHECK(result.objects[0].T_world_object.translation().norm() < 0.002);
}

// The thesis' chapter 6: the front of a cube or of a long box.
TEST_CASE("PnP: a marker of two types is both, until another marker tells") {
  ObjectType cube = marked_box("cube", {0.05, 0.05, 0.05}, 0, 1);
  ObjectType beam = marked_box("beam", {0.15, 0.05, 0.05}, 0, 1);
  beam.features.push_back(marked_box("x", {0.15, 0.05, 0.05}, 0).features[2]);
  const MemoryKnowledgeBase knowledge({cube, beam});
  Random random(4);
  const PlacedObject truth{knowledge.types()[1], {}};
  SUBCASE("both") {
    auto views = cameras_around(random, 2);
    views[0].T_world_cam = Pose::looking_at({0.4, -0.15, 0.1}, {0.07, 0, 0});
    views[1].T_world_cam = Pose::looking_at({0.4, -0.25, 0.2}, {0.07, 0, 0});
    look_at(views, {truth}, {.sigma_px = 0.1}, random);
    const Reconstruction result = reconstruct_pnp(views, knowledge);
    REQUIRE(result.objects.size() == 1);
    const ReconstructedObject& found = result.objects[0];
    REQUIRE(found.alternatives.size() == 1);
    CHECK(found.type != found.alternatives[0].type);
    CHECK(found.probability == doctest::Approx(found.alternatives[0].probability).epsilon(0.01));
    CHECK(sum_of(found) <= 1);
    // Their fronts are at the same place, their centres five centimetres apart.
    const double apart =
        (found.T_world_object.translation() - found.alternatives[0].T_world_object.translation())
            .norm();
    CHECK(apart == doctest::Approx(0.05).epsilon(0.05));
  }
  SUBCASE("one") {
    auto views = cameras_around(random, 1);
    views[0].T_world_cam = Pose::looking_at({0.4, 0.4, 0.1}, {0, 0, 0});
    look_at(views, {truth}, {.sigma_px = 0.1}, random);
    REQUIRE(views[0].observations.size() == 2);
    const Reconstruction result = reconstruct_pnp(views, knowledge);
    REQUIRE(result.objects.size() == 1);
    CHECK(result.objects[0].type->name == "beam");
    CHECK(result.objects[0].alternatives.empty());
  }
}

// The same marker on both ends, and an object that is the same when turned by half a turn.
TEST_CASE("PnP: of poses that a symmetry makes the same, one comes out") {
  ObjectType type = marked_box("dumbbell", {0.1, 0.05, 0.05}, 0, 2);
  const Pose half_turn = turned(Eigen::Vector3d::UnitZ(), std::numbers::pi);
  auto& other = std::get<Marker>(type.features[1].geometry);
  other = std::get<Marker>(type.features[0].geometry);
  other.T_object_marker = half_turn * other.T_object_marker;
  type.features[1].key = type.features[0].key;
  type.symmetries.discrete = {half_turn};
  const MemoryKnowledgeBase knowledge({type});
  for (std::uint32_t seed = 1; seed <= scene_count(20); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Pose truth =
        turned(Eigen::Vector3d::UnitZ(), random.uniform(0, 6.28), {0.02, 0.01, 0.03});
    auto views = cameras_around(random, 4);
    look_at(views, {{knowledge.types()[0], truth}}, {.sigma_px = 0.1}, random);
    const Reconstruction result = reconstruct_pnp(views, knowledge);
    REQUIRE(result.objects.size() == 1);
    const ReconstructedObject& found = result.objects[0];
    CHECK(found.alternatives.empty());
    CHECK(found.probability > 0.9);
    CHECK(pose_error(type, found.T_world_object, truth).m < 0.005);
    // Of the two the one closer to the identity, with the features that are then where they are.
    CHECK(found.T_world_object.rotation().trace() >=
          (found.T_world_object * half_turn).rotation().trace());
    for (const Support& support : found.support) {
      const auto& seen =
          std::get<SeenPoints>(views[support.id.view].observations[support.id.observation].data);
      const CameraView& view = views[support.id.view];
      const auto points = found.type->features[support.feature].points();
      for (std::size_t i = 0; i < 4; ++i) {
        const Eigen::Vector2d pixel =
            view.lens.project(view.T_world_cam->inverse() * (found.T_world_object * points[i]));
        CHECK((pixel - seen.pixels[i]).norm() < 3);
      }
    }
  }
}

TEST_CASE("PnP: measured poses of an object that may be turned around its axis") {
  ObjectType can;
  can.name = "can";
  can.mesh = std::make_shared<const TriangleMesh>(cylinder_solid(0.03, 0.1));
  can.symmetries.continuous.push_back({Eigen::Vector3d::UnitZ()});
  can.features.push_back({{"pose", "can"}, FeaturePose{}});
  const MemoryKnowledgeBase knowledge({can});
  Random random(6);
  const Pose truth = turned({0.6, 0, 0.8}, 0.7, {0.05, -0.02, 0.05});
  auto views = cameras_around(random, 3);
  for (CameraView& view : views) {
    const Pose spun = truth * turned(Eigen::Vector3d::UnitZ(), random.uniform(-3, 3));
    const Pose noisy = moved_by(spun, normal_vector(random, 0.002), normal_vector(random, 0.02));
    view.observations.push_back(
        {{"pose", "can"}, SeenPose{view.T_world_cam->inverse() * noisy, 0.002, 0.02}});
  }
  const Reconstruction result = reconstruct_pnp(views, knowledge);
  REQUIRE(result.objects.size() == 1);
  const ReconstructedObject& found = result.objects[0];
  CHECK(found.support.size() == 3);
  CHECK(found.alternatives.empty());
  CHECK((found.T_world_object.translation() - truth.translation()).norm() < 0.005);
  const Eigen::Vector3d axis = found.T_world_object.rotation().col(2);
  CHECK(axis.dot(truth.rotation().col(2)) > std::cos(0.05));
  // Nothing is known of the turn around the axis, much across it.
  const Eigen::Matrix3d turns = found.covariance->bottomRightCorner<3, 3>();
  CHECK(axis.dot(turns * axis) > 1);
  CHECK(axis.unitOrthogonal().dot(turns * axis.unitOrthogonal()) < 0.001);
}
