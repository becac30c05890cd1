#pragma once

#include <vector>

#include "vantage/volume/volume_options.hpp"

namespace vantage::test {

inline VolumeOptions volume_mode(OccluderMode occluders, std::optional<bool> anti_alias = {}) {
  VolumeOptions options;
  options.occluders = occluders;
  options.anti_alias = anti_alias;
  return options;
}

/// Both kinds of occluders, without and with anti-aliasing.
inline std::vector<VolumeOptions> all_volume_modes() {
  return {volume_mode(OccluderMode::mesh, false), volume_mode(OccluderMode::mesh, true),
          volume_mode(OccluderMode::voxels, false), volume_mode(OccluderMode::voxels, true)};
}

}  // namespace vantage::test
