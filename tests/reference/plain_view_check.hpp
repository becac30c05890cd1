#pragma once

#include <optional>

#include "vantage/planner/view_constraints.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage::test {

/// The slow twin of ViewValidityChecker, for known objects' meshes as occluders: every limit
/// written out, every triangle looked at. Nothing where 1e-5 m would change the answer.
std::optional<InvalidReason> plain_view_check(const WorldModel& world, const StateGrid& grid,
                                              const ViewConstraints& limits,
                                              const DepthRange& range, const Pose& T_world_cam);

}  // namespace vantage::test
