#pragma once

#include "grid/openvdb.hpp"

#include <array>
#include <cstdint>

#include "vantage/volume/grid_geometry.hpp"
#include "vantage/volume/state_grid.hpp"
#include "vantage/volume/volume_report.hpp"

namespace vantage::detail {

/// The voxels of each kind as sets. Uniform blocks are tiles; an empty part of the grid costs
/// nothing. Invariant: `occupied`, `shadow` and `revealed` are disjoint; `measured` is part of
/// `occupied`, `unseen` part of `shadow` and `revealed`; the counts are theirs.
struct StateGridImpl {
  GridGeometry geometry;
  openvdb::MaskTree occupied{false};
  openvdb::MaskTree shadow{false};
  openvdb::MaskTree revealed{false};
  openvdb::MaskTree measured{false};      ///< occupied because of a depth image
  openvdb::MaskTree unseen{false};        ///< shadow that no camera's image covers
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

}  // namespace vantage::detail
