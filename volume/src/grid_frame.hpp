#pragma once

#include <Eigen/Core>

#include "blocks.hpp"
#include "camera_box.hpp"
#include "scan_lines.hpp"
#include "vantage/raycore/points.hpp"

namespace vantage::detail {

/// The voxels of a grid in the grid's own frame: metres from its origin. Everything is decided in
/// this frame, so that floats are as precise for a work area far from the world's origin.
struct GridFrame {
  BlockLayout layout;
  double voxel_size_m;

  explicit GridFrame(const GridGeometry& geometry)
      : layout(geometry), voxel_size_m(geometry.voxel_size_m()) {}

  Eigen::Vector3f centre(const Eigen::Vector3i& voxel) const {
    return {centre_coordinate(voxel.x(), voxel_size_m), centre_coordinate(voxel.y(), voxel_size_m),
            centre_coordinate(voxel.z(), voxel_size_m)};
  }
  /// The box around the voxels' centres.
  Extent extent_of_centres(const CellRange& voxels) const {
    return {0.5 * voxel_size_m * (voxels.first + voxels.last).cast<double>(),
            0.5 * voxel_size_m * (voxels.size().array() - 1).cast<double>()};
  }
  /// The box that the voxels fill.
  Extent extent(const CellRange& voxels) const {
    return {0.5 * voxel_size_m * (voxels.first + voxels.last).cast<double>(),
            0.5 * voxel_size_m * voxels.size().cast<double>()};
  }
};

/// Some voxels of one block, and their centres.
struct VoxelList {
  std::vector<Eigen::Vector3i> voxels;
  Points centres;

  VoxelList(const GridFrame& frame, const Eigen::Vector3i& block, const BlockBits& which) {
    const std::size_t count = std::size_t(which.count());
    voxels.reserve(count);
    centres.reserve(count);
    which.for_each([&](int offset) {
      voxels.push_back(kBlockSide * block + voxel_in_block(offset));
      centres.push_back(frame.centre(voxels.back()));
    });
  }
};

/// Visits a range of blocks by halves: `decide(range)` says whether the whole range is done with;
/// where it is not, its halves are asked, and `visit(block)` is called for what is left.
template <class Decide, class Visit>
void descend(const CellRange& blocks, const Decide& decide, const Visit& visit) {
  if (blocks.empty() || decide(blocks)) return;
  int axis = 0;
  blocks.size().maxCoeff(&axis);
  if (blocks.size()[axis] == 1) return visit(blocks.first);
  CellRange low = blocks, high = blocks;
  low.last[axis] = high.first[axis] = blocks.first[axis] + blocks.size()[axis] / 2;
  descend(low, decide, visit);
  descend(high, decide, visit);
}

}  // namespace vantage::detail
