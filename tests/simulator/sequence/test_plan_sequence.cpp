#include <doctest/doctest.h>

#include <cmath>

#include "simulator/sequence/sequence_scenes.hpp"
#include "simulator/sequence/sequence_settings.hpp"
#include "support/expect_error.hpp"

namespace vantage::test {
namespace {

SequenceSettings planned_events() {
  SequenceSettings settings;
  settings.random.instants = 40;
  settings.random.moves = 0;
  settings.moved = {{"red 1", 2.0, 2.5, Pose::from_translation({0.25, 0, 0.025}), true, "move 1"},
                    {"red 1", 1.0, 1.5, Pose::from_translation({0.2, 0, 0.025}), false, "move 2"}};
  settings.added = {{0.75, "late", six_cubes().objects[0].type,
                     Pose::from_translation({-0.2, 0, 0.025}), "add 1"}};
  settings.taken_away = {{3.0, "late", "take 1"}};
  return settings;
}

void expect_plan_refused(const SequenceSettings& settings, const char* place, const char* message) {
  expect_error(ErrorCode::bad_input, place, message,
               [&] { plan_sequence(six_cubes(), settings, 1); });
}

}  // namespace

TEST_CASE("planned events come in the order of their times, whatever the file's is") {
  const SequencePlan plan = plan_sequence(six_cubes(), planned_events(), 1);
  const SequenceObject& moved = plan.objects[0];
  REQUIRE(moved.stays.size() == 3);
  CHECK(moved.stays[0].to_s == 1.0);
  CHECK_FALSE(moved.stays[0].carried_visibly);
  CHECK(moved.stays[1].T_world_object.translation().x() == 0.2);
  CHECK(moved.stays[2].T_world_object.translation().x() == 0.25);
  REQUIRE(plan.objects.size() == 7);
  CHECK(plan.objects[6].id == 7);
  CHECK(plan.objects[6].stays[0].from_s == 0.75);
  CHECK(plan.objects[6].stays[0].to_s == 3.0);
  CHECK(plan.arm);
  // The arm's tip is over the object while it is carried.
  const Eigen::Vector3d way =
      plan.arm->path.at(2.25) - moment_at(plan, 2.25).objects[0].T_world_object.translation();
  CHECK(way.head<2>().norm() < 1e-9);
  CHECK(way.z() > 0.04);
}

TEST_CASE("cameras out of step are named, others are in step") {
  SequenceSettings settings = planned_events();
  settings.delays_s = {{"right", 0.03}};
  const SequencePlan plan = plan_sequence(six_cubes(), settings, 1);
  CHECK(plan.delay_s(0) == 0);
  CHECK(plan.delay_s(1) == 0.03);
  settings.delays_s = {{"above", 0.03}};
  expect_plan_refused(settings, "delays_s", "above");
}

TEST_CASE("events that cannot happen are refused with their place") {
  SequenceSettings settings = planned_events();
  settings.moved[0].object = "green 1";
  expect_plan_refused(settings, "move 1", "green 1");
  settings = planned_events();
  settings.moved[0].from_s = 1.25;  // while it is carried
  expect_plan_refused(settings, "move 1", "red 1");
  settings = planned_events();
  settings.moved[0].to_s = 2.0;
  expect_plan_refused(settings, "move 1", "ends after it begins");
  settings = planned_events();
  settings.taken_away[0].at_s = 0.5;  // before it is there
  expect_plan_refused(settings, "take 1", "late");
  settings = planned_events();
  settings.added[0].name = "red 1";
  expect_plan_refused(settings, "add 1", "red 1");
  settings = planned_events();
  settings.random.moves = 2;
  expect_plan_refused(settings, "sequence", "random");
}

}  // namespace vantage::test
