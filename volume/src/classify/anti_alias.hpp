#pragma once

#include "grid/block_set.hpp"

namespace vantage::volume::detail {

/// The shadow voxels of a block that have fewer than 5 shadow voxels among their 6 neighbours
/// (thesis 7.2.4): thin layers that the steps of voxels cast. What is outside the grid is no
/// shadow.
BlockBits aliased_shadow(const BlockSet& shadow, std::size_t block);

}  // namespace vantage::volume::detail
