#pragma once

#include <doctest/doctest.h>

#include "reference/thesis_volume.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage::test {

inline void check_same_report(const VolumeReport& a, const VolumeReport& b) {
  CHECK(a.unmeasured_shadow == b.unmeasured_shadow);
  CHECK(a.outside_shadow == b.outside_shadow);
  CHECK(a.aliased_shadow == b.aliased_shadow);
  CHECK(a.warnings == b.warnings);
  REQUIRE(a.conflicts.size() == b.conflicts.size());
  for (std::size_t i = 0; i < a.conflicts.size(); ++i) {
    CHECK(a.conflicts[i].object == b.conflicts[i].object);
    CHECK(a.conflicts[i].voxels == b.conflicts[i].voxels);
    CHECK(a.conflicts[i].of_voxels == b.conflicts[i].of_voxels);
  }
}

/// Checks that two grids say the same of every voxel; they may lie at different places.
inline void expect_same_grid(const StateGrid& a, const StateGrid& b) {
  REQUIRE(a.geometry().size() == b.geometry().size());
  std::size_t differences = 0;
  Eigen::Vector3i last = Eigen::Vector3i::Constant(-1);
  for_each_voxel(a.geometry(), [&](const Eigen::Vector3i& voxel) {
    const bool same = a.at(voxel) == b.at(voxel) && a.measured(voxel) == b.measured(voxel) &&
                      a.shadow_cause(voxel) == b.shadow_cause(voxel);
    if (!same) ++differences, last = voxel;
  });
  CAPTURE(last.transpose());
  CHECK(differences == 0);
  for (const VoxelState state : {VoxelState::free, VoxelState::occupied, VoxelState::shadow}) {
    CHECK(a.count(state) == b.count(state));
  }
  check_same_report(a.report(), b.report());
}

}  // namespace vantage::test
