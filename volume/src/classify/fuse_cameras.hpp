#pragma once

#include <memory>
#include <optional>
#include <span>

#include "classify/camera_visibility.hpp"
#include "classify/depth_integration.hpp"
#include "objects/known_objects.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage::volume::detail {

/// All that one camera contributes.
struct CameraEvidence {
  PinholeCamera camera;  ///< in the grid's frame
  CameraVisibility sight;
  std::optional<DepthEvidence> depth;
  bool traced = false, measured = false;  ///< whether `sight` and `depth` are complete

  CameraEvidence(const PinholeCamera& c, const BlockLayout& layout) : camera(c), sight(layout) {}
};

/// Decides every voxel from what is known and what the cameras say, as `classify` documents it.
std::shared_ptr<const StateGrid> combine(const GridGeometry& geometry, const KnownObjects& known,
                                         std::span<const CameraEvidence> cameras, bool anti_alias);

}  // namespace vantage::volume::detail
