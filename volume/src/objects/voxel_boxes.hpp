#pragma once

#include <vector>

#include "grid/block_set.hpp"

namespace vantage::detail {

/// Boxes of voxels that together are a set, disjoint; none reaches beyond its block. Rows along z
/// are joined along y where they are equal, and those sheets along x.
std::vector<CellRange> voxel_boxes(const BlockSet& set);

}  // namespace vantage::detail
