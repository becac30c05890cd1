#pragma once

#include <span>
#include <vector>

#include "grid/block_set.hpp"
#include "grid/grid_frame.hpp"
#include "objects/occluders.hpp"
#include "objects/silhouette_map.hpp"
#include "vantage/raycore/detail/box_projector.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage::volume::detail {

/// What one camera sees of the work area past the known objects (thesis 7.2.3); what it measured is
/// left aside.
struct CameraVisibility {
  BlockSet covered;  ///< the centre is in the image and in the depth range
  BlockSet clear;    ///< and no known object is in between; of no meaning for solid voxels

  explicit CameraVisibility(const BlockLayout& layout) : covered(layout), clear(layout) {}
};

/// What does not change from camera to camera.
struct KnownSpace {
  const GridFrame& frame;
  const BlockSet& solid;
  const std::vector<std::uint8_t>& surface_octants;  ///< where a known surface may pass through
  const Occluders& occluders;

  bool surface_in(const CellRange& blocks) const;
};

/// Traces one camera. Ranges of blocks are decided at once where the camera's borders and the
/// occluders' outlines prove that all their voxels share one answer; the others voxel by voxel.
/// @param camera in the grid's frame.
CameraVisibility trace_sight(const PinholeCamera& camera, const KnownSpace& known,
                             const StopToken& stop);

/// Brings what a camera sees up to date: traces again what it sees past or through the boxes in
/// which something has changed. That is what tracing all of it gives: whether a voxel is hidden
/// depends on what its line of sight may meet, and on nothing else.
/// @param sight traced with what was known before.
void retrace_sight(const PinholeCamera& camera, const KnownSpace& known,
                   std::span<const Extent> changed, const StopToken& stop, CameraVisibility& sight);

}  // namespace vantage::volume::detail
