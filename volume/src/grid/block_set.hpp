#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "grid/blocks.hpp"

namespace vantage::volume::detail {

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

  void set(std::size_t block, const BlockBits& bits) {
    if (bits.none()) {
      slots_[block] = kNone;
    } else if (bits == layout_.inside(block)) {
      slots_[block] = kAll;
    } else if (slots_[block] >= kFirstMixed) {
      mixed_[layout_.chunk_of(block)][slots_[block] - kFirstMixed] = bits;
    } else {
      const std::size_t chunk = layout_.chunk_of(block);
      if (mixed_[chunk].size() == kBlocksInChunk) forget_uniform(chunk);
      slots_[block] = std::uint8_t(kFirstMixed + mixed_[chunk].size());
      mixed_[chunk].push_back(bits);
    }
  }

  /// Whether a block has the same voxels in another set of this layout.
  bool same(std::size_t block, const BlockSet& other) const {
    if (slots_[block] < kFirstMixed || other.slots_[block] < kFirstMixed) {
      return slots_[block] == other.slots_[block];
    }
    return bits(block) == other.bits(block);
  }

 private:
  static constexpr std::uint8_t kNone = 0, kAll = 1, kFirstMixed = 2;
  static constexpr std::size_t kBlocksInChunk = kChunkSide * kChunkSide * kChunkSide;
  static_assert(kFirstMixed + kBlocksInChunk < 256);

  /// Drops what is left of blocks that were mixed once.
  void forget_uniform(std::size_t chunk) {
    std::vector<BlockBits> mixed;
    layout_.blocks_in_chunk(chunk).for_each([&](const Eigen::Vector3i& at) {
      std::uint8_t& slot = slots_[layout_.index(at)];
      if (slot < kFirstMixed) return;
      mixed.push_back(mixed_[chunk][slot - kFirstMixed]);
      slot = std::uint8_t(kFirstMixed + mixed.size() - 1);
    });
    mixed_[chunk] = std::move(mixed);
  }

  BlockLayout layout_;
  std::vector<std::uint8_t> slots_;
  std::vector<std::vector<BlockBits>> mixed_;  // by chunk
};

/// A block and the six around it.
class Neighbourhood {
 public:
  Neighbourhood(const BlockSet& set, std::size_t block)
      : set_(set), block_(set.layout().block_at(block)), here_(set.bits(block)) {}

  const BlockBits& here() const { return here_; }

  /// Bit for bit whether the neighbour along `axis`, in direction `step`, is in the set.
  BlockBits shifted(int axis, int step) const {
    const BlockBits beyond = at(block_ + step * Eigen::Vector3i::Unit(axis));
    BlockBits result;
    for (int x = 0; x < kBlockSide; ++x) {
      const std::size_t i = std::size_t(x);
      if (axis == 0) {
        const int from = x + step;
        const bool out = from < 0 || from >= kBlockSide;
        result.words[i] =
            out ? beyond.words[std::size_t(from & 7)] : here_.words[std::size_t(from)];
      } else {
        result.words[i] = axis == 1 ? rows(here_.words[i], beyond.words[i], step)
                                    : bits(here_.words[i], beyond.words[i], step);
      }
    }
    return result;
  }

 private:
  static std::uint64_t rows(std::uint64_t here, std::uint64_t beyond, int step) {
    return step > 0 ? (here >> 8) | (beyond << 56) : (here << 8) | (beyond >> 56);
  }
  static std::uint64_t bits(std::uint64_t here, std::uint64_t beyond, int step) {
    constexpr std::uint64_t kFirst = 0x0101010101010101;  // z = 0 of every row
    return step > 0 ? ((here >> 1) & ~(kFirst << 7)) | ((beyond & kFirst) << 7)
                    : ((here << 1) & ~kFirst) | ((beyond >> 7) & kFirst);
  }
  BlockBits at(const Eigen::Vector3i& block) const {
    const CellRange blocks = set_.layout().blocks();
    const bool inside = (block.array() >= 0).all() && (block.array() < blocks.last.array()).all();
    return inside ? set_.bits(set_.layout().index(block)) : BlockBits{};
  }

  const BlockSet& set_;
  Eigen::Vector3i block_;
  BlockBits here_;
};

}  // namespace vantage::volume::detail
