#pragma once

#include <cstdint>
#include <vector>

#include "grid/blocks.hpp"

namespace vantage::detail {

/// A set of voxels. A block with none or all of its voxels costs one byte, any other 64 more.
///
/// Different chunks may be written at once.
class BlockSet {
 public:
  explicit BlockSet(const BlockLayout& layout)
      : layout_(layout), slots_(layout.block_count(), kNone), mixed_(layout.chunk_count()) {}

  const BlockLayout& layout() const { return layout_; }
  bool none(std::size_t block) const { return slots_[block] == kNone; }
  bool all(std::size_t block) const { return slots_[block] == kAll; }

  BlockBits bits(std::size_t block) const {
    switch (slots_[block]) {
      case kNone:
        return {};
      case kAll:
        return layout_.inside(block);
      default:
        return mixed_[layout_.chunk_of(block)][slots_[block] - kFirstMixed];
    }
  }
  bool test(const Eigen::Vector3i& voxel) const {
    const std::size_t block = layout_.block_of(voxel);
    if (slots_[block] < kFirstMixed) return slots_[block] == kAll;
    return mixed_[layout_.chunk_of(block)][slots_[block] - kFirstMixed].test(
        offset_in_block(voxel));
  }

  void set_all(std::size_t block) { slots_[block] = kAll; }

  /// Sets are filled once, or grow: a block that was mixed and became uniform stays uniform.
  void set(std::size_t block, const BlockBits& bits) {
    if (bits.none()) {
      slots_[block] = kNone;
    } else if (bits == layout_.inside(block)) {
      slots_[block] = kAll;
    } else if (slots_[block] >= kFirstMixed) {
      mixed_[layout_.chunk_of(block)][slots_[block] - kFirstMixed] = bits;
    } else {
      std::vector<BlockBits>& mixed = mixed_[layout_.chunk_of(block)];
      slots_[block] = std::uint8_t(kFirstMixed + mixed.size());
      mixed.push_back(bits);
    }
  }

 private:
  static constexpr std::uint8_t kNone = 0, kAll = 1, kFirstMixed = 2;
  static_assert(kFirstMixed + kChunkSide * kChunkSide * kChunkSide < 256);

  BlockLayout layout_;
  std::vector<std::uint8_t> slots_;
  std::vector<std::vector<BlockBits>> mixed_;  // by chunk
};

}  // namespace vantage::detail
