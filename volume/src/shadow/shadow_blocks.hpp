#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "grid/mask_blocks.hpp"
#include "grid/openvdb.hpp"

namespace vantage::volume::detail {

/// A block of 8³ voxels with those that are on, split into components: voxels that are connected by
/// faces inside the block. Components are numbered through all blocks.
struct ShadowBlock {
  openvdb::Coord origin;
  BlockWords words{};
  std::uint32_t first_component = 0;
  std::uint32_t components = 1;
  /// Which of the block's components each voxel belongs to; null where there is only one.
  std::unique_ptr<const std::array<std::uint8_t, 512>> numbers;

  /// Of the voxel with this number in the block: 64x + 8y + z.
  std::uint32_t component_of(std::size_t voxel) const {
    return first_component + (numbers ? (*numbers)[voxel] : 0u);
  }

  /// The voxels of each component.
  std::vector<BlockWords> component_words() const;
};

/// The blocks of a mask, to be found by their place.
class ShadowBlocks {
 public:
  explicit ShadowBlocks(const openvdb::MaskTree& voxels);

  const std::vector<ShadowBlock>& list() const { return list_; }
  std::uint32_t component_count() const { return component_count_; }

  /// For each component, the lowest one among all that are connected with it across blocks.
  std::vector<std::uint32_t> connected() const;

  using Accessor = openvdb::tree::ValueAccessor<const openvdb::Int32Tree>;
  Accessor accessor() const { return Accessor(number_at_); }
  /// The block that holds a voxel; null if there is none.
  const ShadowBlock* at(Accessor& accessor, const openvdb::Coord& voxel) const {
    const std::int32_t number = accessor.getValue(voxel >> 3);
    return number < 0 ? nullptr : &list_[std::size_t(number)];
  }

 private:
  std::vector<ShadowBlock> list_;
  std::uint32_t component_count_ = 0;
  openvdb::Int32Tree number_at_{-1};  ///< in the list, by the block's place among blocks
};

/// Voxels of `within` that are connected by faces with those of `seed` inside the block; bits
/// spread by shifts, all voxels at once.
BlockWords flooded(const BlockWords& seed, const BlockWords& within);

/// The voxels of a block, split into those that are connected by faces inside the block, in the
/// order of their first voxels. There are at most 256.
std::vector<BlockWords> local_components(const BlockWords& words);

}  // namespace vantage::volume::detail
