#pragma once

#include "grid/state_grid_impl.hpp"

namespace vantage::detail {

/// The grid's voxels that are in no other state.
inline openvdb::MaskTree free_voxels(const StateGridImpl& grid) {
  openvdb::MaskTree voxels(false);
  const openvdb::Coord size = to_coord(grid.geometry.size());
  voxels.sparseFill({openvdb::Coord(0), size.offsetBy(-1)}, true, true);
  for (const openvdb::MaskTree* others : {&grid.occupied, &grid.shadow, &grid.revealed}) {
    voxels.topologyDifference(*others);
  }
  return voxels;
}

/// Calls `use` with the voxels of a state; the reference holds during the call only.
template <class Use>
auto with_voxels(const StateGridImpl& grid, VoxelState state, const Use& use) {
  switch (state) {
    case VoxelState::occupied:
      return use(grid.occupied);
    case VoxelState::shadow:
      return use(grid.shadow);
    case VoxelState::revealed:
      return use(grid.revealed);
    case VoxelState::free:
      break;
  }
  const openvdb::MaskTree voxels = free_voxels(grid);
  return use(voxels);
}

}  // namespace vantage::detail
