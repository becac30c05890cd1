#pragma once

#include "grid/openvdb.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace vantage::volume::detail {

/// 8³ voxels as bits: word x, bit 8y + z, as in an OpenVDB leaf.
using BlockWords = std::array<std::uint64_t, 8>;

using BlockMask = openvdb::MaskTree::LeafNodeType::NodeMaskType;

inline constexpr std::uint64_t kAllOn = ~std::uint64_t(0);

inline BlockWords words_of(const BlockMask& mask) {
  BlockWords words;
  for (unsigned x = 0; x < 8; ++x) words[x] = mask.getWord<std::uint64_t>(x);
  return words;
}

inline BlockMask mask_of(const BlockWords& words) {
  BlockMask mask;
  for (unsigned x = 0; x < 8; ++x) mask.getWord<std::uint64_t>(x) = words[x];
  return mask;
}

/// Whether voxel n of a leaf is on.
inline bool is_on(const BlockWords& words, std::size_t n) {
  return words[n >> 6] >> (n & 63) & 1;
}

inline int count_on(const BlockWords& words) {
  int count = 0;
  for (const std::uint64_t word : words) count += std::popcount(word);
  return count;
}

/// Calls `visit(x, y, z)`, x slowest, for every bit that is on.
template <class Visit>
void for_each_on(const BlockWords& words, const Visit& visit) {
  for (int x = 0; x < 8; ++x) {
    for (std::uint64_t rest = words[std::size_t(x)]; rest != 0; rest &= rest - 1) {
      const int bit = std::countr_zero(rest);
      visit(x, bit >> 3, bit & 7);
    }
  }
}

/// A block of a mask with a voxel that is on: a leaf of its tree, or a piece of a tile.
struct MaskBlock {
  openvdb::Coord origin;
  const BlockMask* mask;  ///< in the tree; null in a tile

  bool full() const { return mask == nullptr || mask->isOn(); }
  BlockWords words() const {
    if (mask != nullptr) return words_of(*mask);
    BlockWords all;
    all.fill(kAllOn);
    return all;
  }
};

/// All blocks with voxels that are on, in the tree's order, which is the same whether a uniform
/// block is a leaf, a tile or a part of a larger tile. The tree must outlive them.
std::vector<MaskBlock> mask_blocks(const openvdb::MaskTree& voxels);

/// Reads blocks of a mask by their place. For one thread, and a tree that nobody changes.
class BlockReader {
 public:
  explicit BlockReader(const openvdb::MaskTree& voxels) : at_(voxels) {}

  /// @param origin of a block: multiples of 8.
  BlockWords words(const openvdb::Coord& origin) {
    const auto* leaf = at_.probeConstLeaf(origin);
    if (leaf != nullptr) return words_of(leaf->getValueMask());
    BlockWords words;
    words.fill(at_.isValueOn(origin) ? kAllOn : 0);
    return words;
  }

  /// The 8 voxels along z from one whose z is a multiple of 8.
  std::uint8_t row(const openvdb::Coord& first) {
    const auto* leaf = at_.probeConstLeaf(first);
    if (leaf == nullptr) return at_.isValueOn(first) ? 0xff : 0;
    const std::uint64_t word = leaf->getValueMask().getWord<std::uint64_t>(unsigned(first.x() & 7));
    return std::uint8_t(word >> (8 * (first.y() & 7)));
  }

 private:
  openvdb::tree::ValueAccessor<const openvdb::MaskTree> at_;
};

}  // namespace vantage::volume::detail
