#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "vantage/volume/grid_geometry.hpp"

namespace vantage::volume::detail {

/// A grid is cut into blocks of 8³ voxels, the leaves of OpenVDB, and those into chunks of 4³
/// blocks. Work is shared out by chunk: what one task writes, no other task touches.
inline constexpr int kBlockSide = 8;
inline constexpr int kBlockVoxels = kBlockSide * kBlockSide * kBlockSide;
inline constexpr int kChunkSide = 4;

/// A block's halves along each axis make eight octants; (x, y, z) of an octant are in octants from
/// the grid's origin.
inline constexpr int kOctantSide = kBlockSide / 2;
inline int octant_in_block(const Eigen::Vector3i& octant) {
  return ((octant.x() & 1) << 2) | ((octant.y() & 1) << 1) | (octant.z() & 1);
}

/// One bit for each voxel of a block, ordered as in an OpenVDB leaf: word x, bit 8 y + z.
struct BlockBits {
  std::array<std::uint64_t, kBlockSide> words{};

  static BlockBits all() { return ~BlockBits{}; }
  static BlockBits octant(int octant) {
    const std::uint64_t row = (octant & 1) != 0 ? 0xF0 : 0x0F;
    const std::uint64_t word = (row | row << 8 | row << 16 | row << 24)
                               << ((octant & 2) != 0 ? 32 : 0);
    BlockBits bits;
    for (int x = 0; x < kOctantSide; ++x) {
      bits.words[std::size_t(x + ((octant & 4) != 0 ? kOctantSide : 0))] = word;
    }
    return bits;
  }
  bool test(int offset) const { return (words[std::size_t(offset) >> 6] >> (offset & 63)) & 1; }
  void set(int offset) { words[std::size_t(offset) >> 6] |= std::uint64_t(1) << (offset & 63); }

  std::uint64_t count() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t word : words) sum += std::uint64_t(std::popcount(word));
    return sum;
  }
  bool none() const {
    std::uint64_t any = 0;
    for (const std::uint64_t word : words) any |= word;
    return any == 0;
  }

  /// The lowest and the highest set bit; there must be one.
  int first() const {
    int x = 0;
    while (words[std::size_t(x)] == 0) ++x;
    return 64 * x + std::countr_zero(words[std::size_t(x)]);
  }
  int last() const {
    int x = kBlockSide - 1;
    while (words[std::size_t(x)] == 0) --x;
    return 64 * x + 63 - std::countl_zero(words[std::size_t(x)]);
  }

  /// Calls `visit(offset)` for every set bit, lowest first.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (int x = 0; x < kBlockSide; ++x) {
      for (std::uint64_t word = words[std::size_t(x)]; word != 0; word &= word - 1) {
        visit(64 * x + std::countr_zero(word));
      }
    }
  }

  BlockBits operator~() const {
    BlockBits r;
    for (std::size_t x = 0; x < kBlockSide; ++x) r.words[x] = ~words[x];
    return r;
  }
  BlockBits& operator&=(const BlockBits& o) {
    for (std::size_t x = 0; x < kBlockSide; ++x) words[x] &= o.words[x];
    return *this;
  }
  BlockBits& operator|=(const BlockBits& o) {
    for (std::size_t x = 0; x < kBlockSide; ++x) words[x] |= o.words[x];
    return *this;
  }
  friend BlockBits operator&(BlockBits a, const BlockBits& b) { return a &= b; }
  friend BlockBits operator|(BlockBits a, const BlockBits& b) { return a |= b; }
  bool operator==(const BlockBits&) const = default;
};

/// A voxel's number in its block.
inline int offset_in_block(const Eigen::Vector3i& voxel) {
  return ((voxel.x() & 7) << 6) | ((voxel.y() & 7) << 3) | (voxel.z() & 7);
}
inline Eigen::Vector3i voxel_in_block(int offset) {
  return {offset >> 6, (offset >> 3) & 7, offset & 7};
}

/// Cells [first, last) along each axis: of voxels, blocks or chunks.
struct CellRange {
  Eigen::Vector3i first = Eigen::Vector3i::Zero(), last = Eigen::Vector3i::Zero();

  Eigen::Vector3i size() const { return last - first; }
  bool empty() const { return (size().array() <= 0).any(); }
  CellRange within(const CellRange& other) const {
    return {first.cwiseMax(other.first), last.cwiseMin(other.last)};
  }
  std::size_t count() const {
    return std::size_t(size().x()) * std::size_t(size().y()) * std::size_t(size().z());
  }

  template <class Visit>
  void for_each(const Visit& visit) const {
    for (int i = first.x(); i < last.x(); ++i)
      for (int j = first.y(); j < last.y(); ++j)
        for (int k = first.z(); k < last.z(); ++k) visit(Eigen::Vector3i(i, j, k));
  }
};

/// Numbers the blocks and the chunks of a grid, x slowest.
class BlockLayout {
 public:
  explicit BlockLayout(const GridGeometry& geometry)
      : voxels_(geometry.size()),
        blocks_((voxels_.array() + (kBlockSide - 1)) / kBlockSide),
        chunks_((blocks_.array() + (kChunkSide - 1)) / kChunkSide) {}

  CellRange voxels() const { return {Eigen::Vector3i::Zero(), voxels_}; }
  CellRange blocks() const { return {Eigen::Vector3i::Zero(), blocks_}; }
  std::size_t block_count() const { return blocks().count(); }
  std::size_t chunk_count() const { return CellRange{Eigen::Vector3i::Zero(), chunks_}.count(); }

  std::size_t index(const Eigen::Vector3i& block) const { return number(block, blocks_); }
  std::size_t block_of(const Eigen::Vector3i& voxel) const { return index(voxel / kBlockSide); }
  Eigen::Vector3i block_at(std::size_t index) const { return cell(index, blocks_); }
  std::size_t chunk_of(std::size_t block) const {
    return number(block_at(block) / kChunkSide, chunks_);
  }

  CellRange blocks_in_chunk(std::size_t chunk) const {
    const Eigen::Vector3i first = kChunkSide * cell(chunk, chunks_);
    return CellRange{first, first.array() + kChunkSide}.within(blocks());
  }
  /// The voxels of a range of blocks that lie in the grid.
  CellRange voxels_in(const CellRange& range) const {
    return CellRange{kBlockSide * range.first, kBlockSide * range.last}.within(voxels());
  }
  CellRange voxels_in_block(const Eigen::Vector3i& block) const {
    return voxels_in({block, block.array() + 1});
  }

  /// The bits of a block that lie in the grid: all but at the grid's upper faces.
  BlockBits inside(std::size_t block) const {
    const CellRange range = voxels_in_block(block_at(block));
    const Eigen::Vector3i n = range.size();
    const std::uint64_t row = (std::uint64_t(1) << n.z()) - 1;
    std::uint64_t word = 0;
    for (int y = 0; y < n.y(); ++y) word |= row << (8 * y);
    BlockBits bits;
    for (int x = 0; x < n.x(); ++x) bits.words[std::size_t(x)] = word;
    return bits;
  }

 private:
  static std::size_t number(const Eigen::Vector3i& c, const Eigen::Vector3i& n) {
    return (std::size_t(c.x()) * std::size_t(n.y()) + std::size_t(c.y())) * std::size_t(n.z()) +
           std::size_t(c.z());
  }
  static Eigen::Vector3i cell(std::size_t number, const Eigen::Vector3i& n) {
    const std::size_t nz = std::size_t(n.z()), ny = std::size_t(n.y());
    return {int(number / (nz * ny)), int(number / nz % ny), int(number % nz)};
  }

  Eigen::Vector3i voxels_;
  Eigen::Vector3i blocks_;
  Eigen::Vector3i chunks_;
};

}  // namespace vantage::volume::detail
