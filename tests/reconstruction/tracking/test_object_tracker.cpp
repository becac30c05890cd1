#include <doctest/doctest.h>

#include <map>

#include "reconstruction/tracking/moving_scene.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {
namespace {

/// Objects of both types that do not stand in each other's sight.
void fill(MovingScene& scene) {
  scene.objects = {scene.at(0, -0.15, -0.1, 0.3), scene.at(0, 0.15, -0.1, 1.1),
                   scene.at(1, 0, 0.12, 0.7), scene.at(1, 0, -0.02, 2.0)};
}

/// Events of `count` more snapshots.
std::vector<TrackEvent> watch(MovingScene& scene, ObjectTracker& tracker, int count,
                              TrackedScene* last = nullptr) {
  std::vector<TrackEvent> events;
  for (int i = 0; i < count; ++i) {
    TrackedScene seen = scene.see(tracker);
    events.insert(events.end(), seen.events.begin(), seen.events.end());
    if (last != nullptr) *last = std::move(seen);
  }
  return events;
}

}  // namespace

TEST_CASE("tracking: objects that stand keep their ids, and nothing happens") {
  for (std::uint32_t seed = 1; seed <= scene_count(6); ++seed) {
    CAPTURE(seed);
    MovingScene scene(seed);
    fill(scene);
    scene.noise = {.sigma_px = 0.2, .missing = 0.2, .wrong_id = 0.05};
    ObjectTracker tracker = scene.tracker();
    TrackedScene last;
    const auto events = watch(scene, tracker, 30, &last);
    for (const TrackEvent& event : events) MESSAGE(event.text);
    CHECK(events.empty());
    REQUIRE(last.objects.size() == 4);
    for (const PlacedObject& object : scene.objects) {
      const TrackedObject* found = find_at(last, object.T_world_object);
      REQUIRE(found != nullptr);
      CHECK(found->type == object.type);
      CHECK(found->existence > 0.9);
    }
  }
}

TEST_CASE("tracking: a move is reported within three snapshots, with both places and the same id") {
  for (std::uint32_t seed = 1; seed <= scene_count(12); ++seed) {
    CAPTURE(seed);
    MovingScene scene(seed);
    fill(scene);
    scene.noise = {.sigma_px = 0.2, .missing = 0.2, .wrong_id = 0.05};
    ObjectTracker tracker = scene.tracker();
    TrackedScene before;
    watch(scene, tracker, 5, &before);
    const Pose from = scene.objects[0].T_world_object;
    const TrackedObject* known = find_at(before, from);
    REQUIRE(known != nullptr);
    scene.objects[0] = scene.at(0, -0.1, 0.15, 2.5);
    TrackedScene after;
    const auto events = watch(scene, tracker, 3, &after);
    REQUIRE(events.size() == 1);
    CHECK(events[0].kind == TrackEventKind::moved);
    CHECK(events[0].id == known->id);
    CHECK((events[0].from->translation() - from.translation()).norm() < 0.005);
    CHECK((events[0].to->translation() - scene.objects[0].T_world_object.translation()).norm() <
          0.005);
    REQUIRE(find(after, known->id) != nullptr);
    CHECK(find(after, known->id)->state != TrackState::moving);
    CHECK(after.objects.size() == 4);
    CHECK(watch(scene, tracker, 5).empty());
  }
}

TEST_CASE("tracking: an object that is carried for a while out of sight keeps its id") {
  MovingScene scene(3, 6);
  fill(scene);
  ObjectTracker tracker = scene.tracker();
  TrackedScene before, after;
  watch(scene, tracker, 5, &before);
  const PlacedObject carried = scene.objects[0];
  const TrackId id = find_at(before, carried.T_world_object)->id;
  const double existence = find(before, id)->existence;
  scene.objects.erase(scene.objects.begin());
  CHECK(watch(scene, tracker, 10, &after).empty());  // a second: it may be carried
  const TrackedObject* away = find(after, id);
  REQUIRE(away != nullptr);
  CHECK(away->existence < 0.95 * existence);
  CHECK(away->state == TrackState::missing);
  scene.objects.push_back(scene.at(0, -0.1, 0.15, 2.5));
  const auto events = watch(scene, tracker, 3, &after);
  REQUIRE(events.size() == 1);
  CHECK(events[0].kind == TrackEventKind::moved);
  CHECK(events[0].id == id);
}

TEST_CASE("tracking: an object that is taken away disappears, and is known when it comes back") {
  MovingScene scene(4);
  fill(scene);
  ObjectTracker tracker = scene.tracker();
  TrackedScene last;
  watch(scene, tracker, 5, &last);
  const PlacedObject taken = scene.objects[2];
  const TrackId id = find_at(last, taken.T_world_object)->id;
  const double removed_s = scene.time_s + 0.1;
  scene.objects.erase(scene.objects.begin() + 2);
  auto events = watch(scene, tracker, 40, &last);
  REQUIRE(events.size() == 1);
  CHECK(events[0].kind == TrackEventKind::disappeared);
  CHECK(events[0].id == id);
  CHECK(events[0].time_s == doctest::Approx(removed_s));
  CHECK(find(last, id) == nullptr);
  scene.objects.push_back(taken);
  events = watch(scene, tracker, 4, &last);
  REQUIRE(events.size() == 1);
  CHECK(events[0].kind == TrackEventKind::appeared);
  CHECK(events[0].id == id);
}

TEST_CASE("tracking: a new object appears with an id that none had before") {
  MovingScene scene(5);
  fill(scene);
  ObjectTracker tracker = scene.tracker();
  watch(scene, tracker, 5);
  scene.objects.push_back(scene.at(1, -0.17, 0.13, 0.2));
  TrackedScene last;
  const auto events = watch(scene, tracker, 3, &last);
  REQUIRE(events.size() == 1);
  CHECK(events[0].kind == TrackEventKind::appeared);
  CHECK(events[0].id == 5);
  CHECK(last.objects.size() == 5);
}

TEST_CASE("tracking: an object that something known hides stays, without a word") {
  MovingScene scene(6, 1);
  scene.cameras = {scene.cameras[0]};
  scene.cameras[0].T_world_cam = Pose::looking_at({0, -0.7, 0.15}, {0, 0, 0.03});
  const PlacedObject hidden = scene.at(0, 0, 0.1, 0.2);
  scene.objects = {hidden};
  ObjectTracker tracker = scene.tracker();
  TrackedScene last;
  watch(scene, tracker, 4, &last);
  REQUIRE(find_at(last, hidden.T_world_object) != nullptr);
  scene.objects.push_back(scene.at(1, 0, 0.0, 0.1));  // right before it
  scene.objects.back().T_world_object = Pose::from_translation({0, -0.02, 0.06});
  const auto events = watch(scene, tracker, 60, &last);
  for (const TrackEvent& event : events) CHECK(event.type->name == "box 1");
  const TrackedObject* still = find_at(last, hidden.T_world_object);
  REQUIRE(still != nullptr);
  CHECK(still->state == TrackState::hidden);
  CHECK(still->existence > 0.9);
}

TEST_CASE("tracking: two equal objects that are moved at once may have been exchanged") {
  MovingScene scene(7);
  fill(scene);
  ObjectTracker tracker = scene.tracker();
  TrackedScene last;
  watch(scene, tracker, 5, &last);
  scene.objects[0] = scene.at(0, -0.05, 0.2, 0.5);
  scene.objects[1] = scene.at(0, 0.17, 0.15, 0.9);
  const auto events = watch(scene, tracker, 3, &last);
  REQUIRE(events.size() == 2);
  for (const TrackEvent& event : events) {
    CHECK(event.kind == TrackEventKind::moved);
    const TrackedObject* object = find(last, event.id);
    REQUIRE(object != nullptr);
    REQUIRE(!object->identities.empty());
    CHECK(object->identities[0].probability == doctest::Approx(0.5).epsilon(0.05));
  }
}

TEST_CASE("tracking: phantoms of a single snapshot are not reported") {
  MovingScene scene(8);
  fill(scene);
  ObjectTracker tracker = scene.tracker();
  watch(scene, tracker, 5);
  scene.objects.push_back(scene.at(1, -0.17, 0.13, 0.2));
  TrackedScene last;
  CHECK(watch(scene, tracker, 1, &last).empty());
  CHECK(last.objects.size() == 4);
  scene.objects.pop_back();
  CHECK(watch(scene, tracker, 5, &last).empty());
  CHECK(last.objects.size() == 4);
}

TEST_CASE("tracking: the planner gets the objects that are there, called by their ids") {
  MovingScene scene(9);
  fill(scene);
  ObjectTracker tracker = scene.tracker();
  TrackedScene last;
  watch(scene, tracker, 4, &last);
  const auto known = known_objects(last);
  REQUIRE(known.size() == 4);
  CHECK(known[0].name == "box 0 #1");
  CHECK(known[0].covariance.has_value());
}

TEST_CASE("tracking: times that do not grow, and options without sense, are refused") {
  MovingScene scene(10);
  fill(scene);
  ObjectTracker tracker = scene.tracker();
  watch(scene, tracker, 2);
  scene.time_s -= 0.2;
  expect_bad_input("snapshot", "expected a time after", [&] { scene.see(tracker); });
  scene.time_s += 1;
  scene.cameras.pop_back();
  expect_bad_input("snapshot", "found 2 views; expected 3", [&] { scene.see(tracker); });
  TrackOptions options;
  options.confirmations = 0;
  expect_bad_input("options", "expected", [&] { scene.tracker(options); });
  options = {};
  options.creep_m = -1;
  expect_bad_input("options", "expected", [&] { scene.tracker(options); });
}

}  // namespace vantage::test
