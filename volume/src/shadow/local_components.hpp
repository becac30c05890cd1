#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "grid/mask_blocks.hpp"

namespace vantage::detail {

/// Voxels of `within` that hang together by faces with those of `seed` inside the block; bits
/// spread by shifts, all voxels at once.
BlockWords flooded(const BlockWords& seed, const BlockWords& within);

/// The voxels of a block, split into those that hang together by faces inside the block, in the
/// order of their first voxels. There are at most 256.
std::vector<BlockWords> local_components(const BlockWords& words);

}  // namespace vantage::detail
