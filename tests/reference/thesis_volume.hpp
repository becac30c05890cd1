#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/for_each_voxel.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/volume/grid_geometry.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage::test {

/// A dense grid of labels, x slowest, z fastest.
struct ThesisVolume {
  GridGeometry geometry;
  std::vector<VoxelState> labels;
  std::vector<char> unseen;  ///< in no camera's image and depth range

  /// The label hangs on a centre that is so close to an image's border or to the end of a depth
  /// range that float and double may disagree.
  std::vector<char> close_call;

  std::size_t index(const Eigen::Vector3i& voxel) const;
  std::uint64_t count(VoxelState state) const;
};

/// The thesis' algorithm on a regular grid, as plain as it can be, in double: every voxel that is
/// not solid starts as shadow, and is free if some camera has its centre in view and the segment
/// from the centre to the camera meets no solid voxel: every ray against every solid voxel
/// (7.2.3). Then, if asked for, anti-aliasing (7.2.4).
///
/// A voxel is a closed cube, grown by 1e-9 of its size: a ray that touches an edge meets it.
/// @param solid one for each voxel, in the order of the labels (7.2.2).
ThesisVolume thesis_volume(const GridGeometry& geometry, const std::vector<char>& solid,
                           std::span<const PinholeCamera> cameras, bool anti_alias);

/// Frees, all at once, every shadow voxel with fewer than 5 shadow voxels among its 6 neighbours.
void thesis_anti_alias(ThesisVolume& volume);

}  // namespace vantage::test
