#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vantage/raycore/points.hpp"
#include "vantage/volume/grid_geometry.hpp"

namespace vantage::detail {

/// A grid cut into blocks of 8³ voxels, the leaves of OpenVDB. Work is shared out by block: no two
/// tasks touch the same word of a mask.
inline constexpr int kBlockSide = 8;
inline constexpr int kBlockVoxels = kBlockSide * kBlockSide * kBlockSide;

/// A voxel's number in its block: x slowest, z fastest, as in an OpenVDB leaf.
inline int offset_in_block(const Eigen::Vector3i& voxel) {
  return ((voxel.x() & 7) << 6) | ((voxel.y() & 7) << 3) | (voxel.z() & 7);
}

class BlockLayout {
 public:
  explicit BlockLayout(const GridGeometry& geometry)
      : grid_(geometry.size()), blocks_((grid_.array() + (kBlockSide - 1)) / kBlockSide) {}

  std::size_t count() const {
    return std::size_t(blocks_.x()) * std::size_t(blocks_.y()) * std::size_t(blocks_.z());
  }
  std::size_t block_of(const Eigen::Vector3i& voxel) const {
    const Eigen::Vector3i b = voxel / kBlockSide;
    return (std::size_t(b.x()) * std::size_t(blocks_.y()) + std::size_t(b.y())) *
               std::size_t(blocks_.z()) +
           std::size_t(b.z());
  }
  Eigen::Vector3i first_voxel(std::size_t block) const {
    const std::size_t nz = std::size_t(blocks_.z()), ny = std::size_t(blocks_.y());
    return kBlockSide *
           Eigen::Vector3i(int(block / (nz * ny)), int(block / nz % ny), int(block % nz));
  }

  /// Calls `visit(voxel, offset)` for the voxels of a block that lie in the grid, by offset.
  template <class Visit>
  void for_each_voxel(std::size_t block, const Visit& visit) const {
    const Eigen::Vector3i first = first_voxel(block);
    const Eigen::Vector3i last = (first.array() + kBlockSide).min(grid_.array());
    for (int i = first.x(); i < last.x(); ++i)
      for (int j = first.y(); j < last.y(); ++j)
        for (int k = first.z(); k < last.z(); ++k) {
          const Eigen::Vector3i voxel(i, j, k);
          visit(voxel, offset_in_block(voxel));
        }
  }

 private:
  Eigen::Vector3i grid_;
  Eigen::Vector3i blocks_;
};

/// One bit for every voxel.
class VoxelMask {
 public:
  explicit VoxelMask(const BlockLayout& layout) : layout_(layout), words_(layout.count()) {}

  bool test(std::size_t block, int offset) const {
    return (words_[block][std::size_t(offset) >> 6] >> (offset & 63)) & 1;
  }
  void set(std::size_t block, int offset) {
    words_[block][std::size_t(offset) >> 6] |= std::uint64_t(1) << (offset & 63);
  }
  void set(const Eigen::Vector3i& voxel) { set(layout_.block_of(voxel), offset_in_block(voxel)); }
  void clear() { std::fill(words_.begin(), words_.end(), Words{}); }

 private:
  using Words = std::array<std::uint64_t, kBlockVoxels / 64>;
  BlockLayout layout_;
  std::vector<Words> words_;
};

}  // namespace vantage::detail
