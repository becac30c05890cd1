#include <doctest/doctest.h>

#include "reconstruction/synthetic_views.hpp"
#include "support/scene_count.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

/// How many objects were found, and how many of them are where an object of the type is.
struct Tally {
  std::size_t seen = 0, found = 0, right = 0;
  double recall() const { return double(right) / double(seen); }
  double precision() const { return double(right) / double(found); }
};

void count(const Reconstruction& result, const std::vector<PlacedObject>& objects,
           const std::vector<std::vector<int>>& owners, Tally& tally) {
  std::vector<bool> seen(objects.size(), false), taken(objects.size(), false);
  for (const auto& of_view : owners) {
    for (const int owner : of_view) {
      if (owner != kNobody) seen[std::size_t(owner)] = true;
    }
  }
  tally.seen += std::size_t(std::count(seen.begin(), seen.end(), true));
  for (const ReconstructedObject& object : result.objects) {
    ++tally.found;
    for (std::size_t i = 0; i < objects.size(); ++i) {
      if (!seen[i] || taken[i] || objects[i].type != object.type) continue;
      const PoseError error =
          pose_error(*object.type, object.T_world_object, objects[i].T_world_object);
      if (error.m > 0.01 || error.rad > 0.2) continue;
      taken[i] = true;
      ++tally.right;
      break;
    }
  }
}

Tally clutter(const ViewNoise& noise, int cameras, std::uint32_t scenes) {
  const MemoryKnowledgeBase knowledge(
      {marked_box("cube", {0.05, 0.05, 0.05}, 0), marked_box("dice", {0.05, 0.05, 0.05}, 6),
       marked_box("brick", {0.08, 0.05, 0.04}, 12), marked_box("tower", {0.06, 0.06, 0.1}, 18)});
  Tally tally;
  for (std::uint32_t seed = 1; seed <= scenes; ++seed) {
    Random random(seed);
    auto views = cameras_around(random, cameras);
    const auto objects = scattered(random, knowledge.types(), 16, 0.22);
    const auto owners = look_at(views, objects, noise, random);
    count(reconstruct_pnp(views, knowledge), objects, owners, tally);
  }
  MESSAGE(cameras << " cameras: recall " << tally.recall() << " of " << tally.seen << ", precision "
                  << tally.precision() << " of " << tally.found);
  return tally;
}

/// In one scene, as under the sanitizers, one marker is several percent.
void expect_more_than(double recall, double precision, const Tally& tally) {
  if (!kAllScenes) return;
  CHECK(tally.recall() > recall);
  CHECK(tally.precision() > precision);
}

}  // namespace

TEST_CASE("PnP: many instances of each type, their number not given") {
  expect_more_than(0.99, 0.99, clutter({}, 5, scene_count(20)));
}

TEST_CASE("PnP: 20 % of the markers missing, 5 % read as another one") {
  const ViewNoise noise{.missing = 0.2, .wrong_id = 0.05};
  expect_more_than(0.98, 0.95, clutter(noise, 4, scene_count(30)));
  expect_more_than(0.99, 0.99, clutter(noise, 9, scene_count(10)));
}

// Side by side, same markers, same turn: whatever the cameras see of one, they see of the next one
// too, five centimetres on.
TEST_CASE("PnP: a row of touching cubes of one type") {
  const MemoryKnowledgeBase knowledge({marked_box("cube", {0.05, 0.05, 0.05}, 0)});
  Tally tally;
  for (std::uint32_t seed = 1; seed <= scene_count(30); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    auto views = cameras_around(random, 4);
    std::vector<PlacedObject> objects;
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector3d place(0.05 * (i % 3) - 0.05, 0.05 * (i / 3), 0.025);
      objects.push_back({knowledge.types()[0], Pose::from_translation(place)});
    }
    const auto owners = look_at(views, objects, {.missing = 0.1}, random);
    const Reconstruction result = reconstruct_pnp(views, knowledge);
    count(result, objects, owners, tally);
    for (const ReconstructedObject& object : result.objects) {
      const ObservationId first = object.support.front().id;
      for (const Support& support : object.support) {
        CHECK(owners[support.id.view][support.id.observation] ==
              owners[first.view][first.observation]);
      }
    }
  }
  CHECK(tally.recall() > 0.99);
  CHECK(tally.precision() > 0.99);
}

TEST_CASE("PnP: an object that two cameras see from opposite sides is one object") {
  const MemoryKnowledgeBase knowledge({marked_box("box", {0.08, 0.05, 0.05}, 0)});
  Random random(1);
  auto views = cameras_around(random, 2);
  views[0].T_world_cam = Pose::looking_at({0.5, 0.02, 0.1}, {0, 0, 0});
  views[1].T_world_cam = Pose::looking_at({-0.5, 0.03, 0.1}, {0, 0, 0});
  look_at(views, {{knowledge.types()[0], {}}}, {.sigma_px = 0.1}, random);
  REQUIRE(views[0].observations.size() >= 1);
  REQUIRE(views[1].observations.size() >= 1);
  const Reconstruction result = reconstruct_pnp(views, knowledge);
  REQUIRE(result.objects.size() == 1);
  CHECK(result.objects[0].T_world_object.translation().norm() < 0.001);
}

TEST_CASE("PnP: a misread marker is neither an object nor a part of one") {
  const MemoryKnowledgeBase knowledge(
      {marked_box("cube", {0.05, 0.05, 0.05}, 0), marked_box("dice", {0.06, 0.06, 0.06}, 6)});
  Random random(9);
  auto views = cameras_around(random, 4);
  look_at(views, {{knowledge.types()[0], Pose::from_translation({0, 0, 0.025})}}, {}, random);
  REQUIRE(views[1].observations.size() >= 2);
  const FeatureKey true_key = views[1].observations[0].key;
  views[1].observations[0].key = marker_key("4X4_250", 8);
  const Reconstruction result = reconstruct_pnp(views, knowledge);
  REQUIRE(result.objects.size() == 1);
  CHECK(result.objects[0].type->name == "cube");
  REQUIRE(result.unexplained.size() == 1);
  CHECK(result.unexplained[0].id == ObservationId{1, 0});
  CHECK(result.unexplained[0].reason.find("misread") != std::string::npos);
  CHECK(result.unexplained[0].reason.find(true_key.value) != std::string::npos);
}

TEST_CASE("PnP: an object whose other markers should be visible but are not is left out") {
  const MemoryKnowledgeBase knowledge({marked_box("cube", {0.08, 0.08, 0.08}, 0)});
  Random random(2);
  auto views = cameras_around(random, 6, 0.5);
  look_at(views, {{knowledge.types()[0], {}}}, {}, random);
  const Reconstruction all = reconstruct_pnp(views, knowledge);
  REQUIRE(all.objects.size() == 1);
  CHECK(all.objects[0].probability > 0.99);
  // The cameras now see something else instead, far away.
  std::size_t kept = 0;
  for (CameraView& view : views) {
    const Observation first = view.observations.front();
    view.observations.clear();
    if (kept++ == 0) view.observations.push_back(first);
    view.observations.push_back({{"aruco", "4X4/200"}, std::get<SeenPoints>(first.data)});
  }
  const Reconstruction one = reconstruct_pnp(views, knowledge);
  CHECK(one.objects.empty());
  REQUIRE(one.unexplained.size() == 7);
  CHECK(one.unexplained[0].reason.find("should be seen") != std::string::npos);
}
