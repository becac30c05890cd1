#pragma once

#include "reference/random_workcell.hpp"
#include "vantage/planner/plan.hpp"

namespace vantage::test {

/// A small plan by the thesis' numbers: what views have in sight, of all of the shadow.
inline PlanRequest small_request() {
  return {.work_area = random_workcell_area(),
          .intrinsics = {64, 48, 70, 70, 31.5, 23.5},
          .range = {0.1, 2},
          .voxel_size_m = 0.01,
          .value = ViewValue::bound,
          .views = {.min_gain_share = 0},
          .volume = {.filter = FalseShadowFilter::off}};
}

/// A wall across x that one camera sees from -y.
inline WorldModel wall_world() {
  WorldModel world;
  world.objects.push_back({"wall",
                           std::make_shared<const TriangleMesh>(
                               TriangleMesh::from_box(Box({-0.1, -0.02, 0}, {0.1, 0.02, 0.18}))),
                           {}});
  world.cameras.push_back({"front",
                           PinholeCamera({64, 48, 70, 70, 31.5, 23.5},
                                         Pose::looking_at({0, -0.6, 0.15}, {0, 0, 0.08}), {0.1, 2}),
                           nullptr});
  return world;
}

}  // namespace vantage::test
