#pragma once

#include <Eigen/Core>

#include "grid/blocks.hpp"
#include "vantage/raycore/detail/box_projector.hpp"
#include "vantage/raycore/points.hpp"

namespace vantage::volume::detail {

/// The coordinate of a voxel's centre as the rays see it.
inline float centre_coordinate(int index, double voxel_size_m) {
  return float(voxel_size_m * (index + 0.5));
}

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

/// Some voxels of one block and their centres, in order, on the stack: a thousand of these a
/// millisecond leave no time for allocations.
class BlockVoxels {
 public:
  BlockVoxels(const GridFrame& frame, const Eigen::Vector3i& block, const BlockBits& which)
      : first_(kBlockSide * block) {
    float x[kBlockSide], y[kBlockSide], z[kBlockSide];
    for (int i = 0; i < kBlockSide; ++i) {
      x[i] = centre_coordinate(first_.x() + i, frame.voxel_size_m);
      y[i] = centre_coordinate(first_.y() + i, frame.voxel_size_m);
      z[i] = centre_coordinate(first_.z() + i, frame.voxel_size_m);
    }
    which.for_each([&](int offset) {
      offsets_[count_] = std::uint16_t(offset);
      x_[count_] = x[offset >> 6], y_[count_] = y[(offset >> 3) & 7], z_[count_] = z[offset & 7];
      ++count_;
    });
  }

  std::size_t size() const { return count_; }
  int offset(std::size_t i) const { return offsets_[i]; }
  Eigen::Vector3i voxel(std::size_t i) const { return first_ + voxel_in_block(offsets_[i]); }
  PointsView centres() const { return {x_, y_, z_, count_}; }

  /// The bits of those voxels for which `flags` has `value`.
  BlockBits where(const std::uint8_t* flags, std::uint8_t value) const {
    BlockBits bits;
    for (std::size_t i = 0; i < count_; ++i) {
      bits.words[std::size_t(offsets_[i]) >> 6] |= std::uint64_t(flags[i] == value)
                                                   << (offsets_[i] & 63);
    }
    return bits;
  }

 private:
  Eigen::Vector3i first_;
  std::size_t count_ = 0;
  std::uint16_t offsets_[kBlockVoxels];
  float x_[kBlockVoxels], y_[kBlockVoxels], z_[kBlockVoxels];
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

}  // namespace vantage::volume::detail
