#pragma once

#include "openvdb.hpp"

#include <array>
#include <cstdint>

#include "vantage/volume/grid_geometry.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage::detail {

struct StateGridImpl {
  GridGeometry geometry;
  openvdb::Int32Tree states{0};           ///< values of VoxelState; free voxels are inactive
  openvdb::MaskTree measured{false};      ///< occupied because of a depth image
  std::array<std::uint64_t, 4> counts{};  ///< by VoxelState

  explicit StateGridImpl(const GridGeometry& g) : geometry(g) {}
};

inline openvdb::Coord to_coord(const Eigen::Vector3i& v) {
  return {v.x(), v.y(), v.z()};
}
inline Eigen::Vector3i to_voxel(const openvdb::Coord& c) {
  return {c.x(), c.y(), c.z()};
}

}  // namespace vantage::detail
