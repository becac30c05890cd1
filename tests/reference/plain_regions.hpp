#pragma once

#include <cstdint>
#include <vector>

#include "vantage/volume/advanced/shadow_regions.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage::test {

/// The slow, obvious twin of `ShadowRegions`: a breadth-first search, voxel by voxel, on a dense
/// array.
struct PlainRegions {
  std::vector<ShadowRegion> list;
  std::vector<std::int32_t> labels;  ///< x slowest, z fastest

  explicit PlainRegions(const StateGrid& grid);
};

}  // namespace vantage::test
