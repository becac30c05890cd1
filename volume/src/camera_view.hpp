#pragma once

#include "blocks.hpp"
#include "vantage/raycore/scene.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/grid_geometry.hpp"

namespace vantage::detail {

/// What is known of the voxels so far.
struct Evidence {
  VoxelMask solid;    ///< inside a known object
  VoxelMask free;     ///< seen through by some camera
  VoxelMask surface;  ///< at a surface that some depth image shows

  explicit Evidence(const BlockLayout& layout) : solid(layout), free(layout), surface(layout) {}
};

/// What one camera says about the voxels. `add_block` may run for different blocks at once.
class CameraView {
 public:
  /// All arguments must outlive the view. `known` is null where there is no known object.
  CameraView(const Observer& observer, const GridGeometry& geometry, const BlockLayout& layout,
             const Scene* known);

  /// Adds to `evidence.free` and `evidence.surface` of a block; voxels that are solid, or free
  /// already, are left alone.
  void add_block(std::size_t block, Evidence& evidence) const;

 private:
  struct Candidates;
  void mark_measured_points();
  void keep_in_view(Candidates& candidates) const;
  void compare_with_depth(Candidates& candidates, std::size_t block, Evidence& evidence) const;

  const Observer& observer_;
  const GridGeometry& geometry_;
  const BlockLayout& layout_;
  const Scene* known_;
  VoxelMask measured_points_;  ///< voxels in which this camera measured a point
};

}  // namespace vantage::detail
