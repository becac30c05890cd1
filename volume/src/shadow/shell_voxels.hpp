#pragma once

#include "grid/openvdb.hpp"

#include "vantage/volume/state_grid.hpp"

namespace vantage::volume::detail {

/// The shadow and the voxels next to it, also beyond the grid's box: what lies within
/// `shell_around_shadow`.
openvdb::MaskTree shell_voxels(const StateGrid& grid);

}  // namespace vantage::volume::detail
