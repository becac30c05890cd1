#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "vantage/raycore/export.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage {

/// A connected component of shadow voxels.
struct ShadowRegion {
  std::uint64_t voxels = 0;
  std::uint64_t unmeasured_voxels = 0;  ///< of them, by `ShadowCause`; the rest is hidden
  std::uint64_t outside_voxels = 0;
  Eigen::Vector3i first_voxel;  ///< the one with the lowest i, of these the lowest j, then k
  Eigen::Vector3i min_voxel;    ///< the bounding box, in voxels
  Eigen::Vector3i max_voxel;    ///< inclusive
  Eigen::Vector3d centroid_m;   ///< mean of the voxels' centres, world frame
};

/// The connected components of a grid's shadow: voxels are connected where they share a face.
/// Revealed voxels are not shadow any more.
///
/// Immutable and thread-safe. Memory is proportional to the blocks of 8³ voxels that hold shadow.
/// Runs in the caller's task arena; the result is the same at any number of threads.
class VANTAGE_API ShadowRegions {
 public:
  explicit ShadowRegions(const StateGrid& grid);
  ~ShadowRegions();
  ShadowRegions(ShadowRegions&&) noexcept;
  ShadowRegions& operator=(ShadowRegions&&) noexcept;

  const GridGeometry& geometry() const noexcept;

  /// Largest first; among equals, the one with the lower first voxel.
  const std::vector<ShadowRegion>& list() const noexcept;

  /// 1 for the largest region, 2 for the next …; 0 where there is no shadow.
  std::int32_t label(const Eigen::Vector3i& voxel) const;

  /// The labels of voxels (i, j, 0), (i, j, 1) … to the end of the grid; `row` has a place for
  /// each.
  void labels_of_row(int i, int j, std::int32_t* row) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace vantage
