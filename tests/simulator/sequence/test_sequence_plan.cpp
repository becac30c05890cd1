#include "simulator/sequence/sequence_plan.hpp"

#include <doctest/doctest.h>

#include "simulator/sequence/sequence_scenes.hpp"
#include "support/expect_error.hpp"

namespace vantage::test {
namespace {

using doctest::Approx;

/// A cube that stands at x = 0, is moved to x = 0.3 between 1 s and 2 s, and is taken away at 3 s.
SequencePlan moved_cube(bool visibly) {
  SequencePlan plan{.instants = 40};
  plan.objects = {
      {1,
       "cube",
       marked_cube("cube", 0),
       {{.to_s = 1, .T_world_object = {}, .carried_visibly = visibly},
        {.from_s = 2, .to_s = 3, .T_world_object = Pose::from_translation({0.3, 0, 0})}}}};
  return plan;
}

}  // namespace

TEST_CASE("an object stands, is lifted, carried over, put down, and taken away") {
  const SequencePlan plan = moved_cube(true);
  plan.check();
  CHECK(moment_at(plan, -1).objects.empty());
  CHECK_FALSE(moment_at(plan, 0.99).objects.at(0).carried);
  const auto at = [&](double time_s) { return moment_at(plan, time_s).objects.at(0); };
  CHECK(at(1.5).carried);
  CHECK(at(1.5).T_world_object.translation().isApprox(Eigen::Vector3d(0.15, 0, kLiftM), 1e-9));
  CHECK(at(1.1).T_world_object.translation().x() == Approx(0));
  CHECK(at(1.1).T_world_object.translation().z() == Approx(0.4 * kLiftM));
  CHECK(at(1.9).T_world_object.translation().x() == Approx(0.3));
  CHECK_FALSE(at(2).carried);
  CHECK(moment_at(plan, 3).objects.empty());
}

TEST_CASE("in a closed hand nothing is there on the way") {
  const SequencePlan plan = moved_cube(false);
  CHECK(moment_at(plan, 1.5).objects.empty());
  CHECK(moment_at(plan, 2.5).objects.size() == 1);
}

TEST_CASE("plans that make no sense are refused with the object's name") {
  SequencePlan plan = moved_cube(true);
  plan.objects[0].stays[1].from_s = 0.5;
  expect_error(ErrorCode::bad_input, "cube", "", [&] { plan.check(); });
  plan = moved_cube(true);
  plan.objects.push_back(plan.objects[0]);
  expect_error(ErrorCode::bad_input, "cube", "", [&] { plan.check(); });
  plan = moved_cube(true);
  plan.period_s = 0;
  expect_error(ErrorCode::bad_input, "period_s", "", [&] { plan.check(); });
}

TEST_CASE("the arm's links hang together, and its gripper reaches the point") {
  const Arm arm({0.6, 0, 0.35}, 1.2);
  for (const Eigen::Vector3d& tip : std::vector<Eigen::Vector3d>{
           {0, 0, 0.05}, {-0.3, 0.2, 0.1}, {0.3, -0.2, 0.3}, {0.48, 0, 0.45}}) {
    const std::vector<ArmPart> parts = arm.at(tip);
    REQUIRE(parts.size() == 3);
    const Eigen::Vector3d elbow = parts[0].T_world_part * Eigen::Vector3d(0, 0, 0.6);
    const Eigen::Vector3d wrist = parts[1].T_world_part * Eigen::Vector3d(0, 0, 0.6);
    CHECK((parts[0].T_world_part.translation() - arm.shoulder()).norm() < 1e-9);
    CHECK((parts[1].T_world_part.translation() - elbow).norm() < 1e-9);
    CHECK((wrist - tip - Eigen::Vector3d(0, 0, Arm::kGripperM)).norm() < 1e-9);
    CHECK(elbow.z() > std::min(wrist.z(), arm.shoulder().z()));
  }
}

TEST_CASE("the arm's tip goes on straight lines from point to point") {
  const ArmPath path{{{0, {0, 0, 0}}, {2, {2, 0, 0}}, {3, {2, 4, 0}}}};
  CHECK(path.at(-1) == Eigen::Vector3d(0, 0, 0));
  CHECK(path.at(1).isApprox(Eigen::Vector3d(1, 0, 0)));
  CHECK(path.at(2.25).isApprox(Eigen::Vector3d(2, 1, 0)));
  CHECK(path.at(9) == Eigen::Vector3d(2, 4, 0));
}

}  // namespace vantage::test
