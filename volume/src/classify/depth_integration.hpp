#pragma once

#include "grid/block_set.hpp"
#include "grid/grid_frame.hpp"
#include "vantage/raycore/depth_image.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage::volume::detail {

/// What one depth image says of the voxels whose centres are in its view; known objects are left
/// aside. A voxel in none of the sets is behind the surface.
struct DepthEvidence {
  BlockSet through;  ///< in front of the surface band at the nearest pixel: seen through
  BlockSet surface;  ///< in the band, or a measured point lies in the voxel
  BlockSet unknown;  ///< no depth at the nearest pixel, and no measured point in the voxel

  explicit DepthEvidence(const BlockLayout& layout)
      : through(layout), surface(layout), unknown(layout) {}
};

/// Compares the work area with a depth image. Ranges of blocks in front of, or behind, everything
/// that the pixels over them measured are decided at once.
/// @param camera in the grid's frame; fits the image.
/// @param covered the voxels in the camera's view.
DepthEvidence compare_with_depth(const PinholeCamera& camera, const DepthImage& depth,
                                 const GridFrame& frame, const BlockSet& covered,
                                 const VolumeOptions& options, const StopToken& stop);

}  // namespace vantage::volume::detail
