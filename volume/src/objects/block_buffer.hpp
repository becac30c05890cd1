#pragma once

#include <cstddef>
#include <vector>

#include "grid/block_set.hpp"
#include "objects/object_voxels.hpp"

namespace vantage::volume::detail {

/// Numbers the cells of a range, x slowest.
inline std::size_t index_in(const CellRange& range, const Eigen::Vector3i& cell) {
  const Eigen::Vector3i c = cell - range.first, n = range.size();
  return (std::size_t(c.x()) * std::size_t(n.y()) + std::size_t(c.y())) * std::size_t(n.z()) +
         std::size_t(c.z());
}

/// A box of blocks that is filled voxel by voxel, then stripped of the empty ones.
class BlockBuffer {
 public:
  BlockBuffer(const BlockLayout& layout, const CellRange& voxels)
      : layout_(layout),
        range_{voxels.first / kBlockSide, (voxels.last.array() + (kBlockSide - 1)) / kBlockSide},
        bits_(range_.count()) {}

  void set(const Eigen::Vector3i& voxel) {
    bits_[index_in(range_, voxel / kBlockSide)].set(offset_in_block(voxel));
  }

  ObjectVoxels finish() const {
    ObjectVoxels result;
    range_.for_each([&](const Eigen::Vector3i& block) {
      const BlockBits& bits = bits_[index_in(range_, block)];
      if (!bits.none()) result.blocks.push_back({layout_.index(block), bits});
    });
    return result;
  }

 private:
  const BlockLayout& layout_;
  CellRange range_;
  std::vector<BlockBits> bits_;
};

}  // namespace vantage::volume::detail
