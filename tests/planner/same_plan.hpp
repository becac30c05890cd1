#pragma once

#include <doctest/doctest.h>

#include "vantage/planner/plan.hpp"

namespace vantage::test {

inline bool same_pose(const Pose& a, const Pose& b) {
  return a.translation() == b.translation() && a.rotation() == b.rotation();
}

inline void expect_same_view(const RankedView& a, const RankedView& b) {
  CHECK(a.candidate == b.candidate);
  CHECK(same_pose(a.T_world_cam, b.T_world_cam));
  CHECK(a.servo_iteration == b.servo_iteration);
  CHECK(a.score == b.score);
  CHECK(a.utility == b.utility);
  CHECK(a.polish.size() == b.polish.size());
}

inline void expect_same_steps(const std::vector<ScoredStep>& a, const std::vector<ScoredStep>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(same_pose(a[i].step.T_world_cam, b[i].step.T_world_cam));
    CHECK(a[i].step.move == b[i].step.move);
    CHECK(a[i].score == b[i].score);
  }
}

/// The same to the bit, but for why candidates were rejected.
inline void expect_same_plan(const Plan& a, const Plan& b) {
  REQUIRE(a.candidates.size() == b.candidates.size());
  for (std::size_t i = 0; i < a.candidates.size(); ++i) {
    const bool rejected = a.candidates[i].rejected != InvalidReason::none;
    CHECK(rejected == (b.candidates[i].rejected != InvalidReason::none));
    CHECK(a.candidates[i].score == b.candidates[i].score);
  }
  REQUIRE(a.ranked.size() == b.ranked.size());
  for (std::size_t i = 0; i < a.ranked.size(); ++i) expect_same_view(a.ranked[i], b.ranked[i]);
  REQUIRE(a.views.size() == b.views.size());
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    expect_same_view(a.views[i].view, b.views[i].view);
    CHECK(a.views[i].revealed_voxels == b.views[i].revealed_voxels);
  }
  expect_same_steps(a.trace, b.trace);
}

}  // namespace vantage::test
