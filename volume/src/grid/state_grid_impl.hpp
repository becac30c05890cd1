#pragma once

#include <array>
#include <cstdint>

#include "grid/openvdb.hpp"
#include "vantage/volume/grid_geometry.hpp"
#include "vantage/volume/state_grid.hpp"
#include "vantage/volume/volume_report.hpp"

namespace vantage::volume::detail {

/// The voxels of each kind as sets. Uniform blocks are tiles; an empty part of the grid costs
/// nothing. Invariant: `occupied`, `shadow` and `revealed` are disjoint; `measured` is part of
/// `occupied`, `unmeasured` and `outside` are disjoint parts of `shadow` and `revealed`; the counts
/// are theirs.
struct StateGridImpl {
  GridGeometry geometry;
  openvdb::MaskTree occupied{false};
  openvdb::MaskTree shadow{false};
  openvdb::MaskTree revealed{false};
  openvdb::MaskTree measured{false};      ///< occupied because of a depth image
  openvdb::MaskTree unmeasured{false};    ///< shadow where images have no reading
  openvdb::MaskTree outside{false};       ///< shadow that no camera's image covers
  std::array<std::uint64_t, 4> counts{};  ///< by VoxelState
  VolumeReport report;

  explicit StateGridImpl(const GridGeometry& g) : geometry(g) {}
};

inline openvdb::Coord to_coord(const Eigen::Vector3i& v) {
  return {v.x(), v.y(), v.z()};
}
inline Eigen::Vector3i to_voxel(const openvdb::Coord& c) {
  return {c.x(), c.y(), c.z()};
}

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

}  // namespace vantage::volume::detail
