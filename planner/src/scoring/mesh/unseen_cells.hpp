#pragma once

#include <vector>

#include "vantage/planner/advanced/mesh_scorer.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/detail/box_projector.hpp"

namespace vantage::planner::detail {

/// The tiles of an image that may show something unseen, in the image's order.
struct UnseenTiles {
  std::vector<PixelTile> tiles;
  double farthest_m = 0;  ///< no unseen surface is farther away
};

/// Where there may be something unseen: boxes of a few voxels around what the filter left of it,
/// so that most of an image's tiles are known to be empty before the first ray is traced.
class UnseenCells {
 public:
  explicit UnseenCells(const SeenWorld& world);

  /// Certified: pixels of all other tiles meet nothing unseen.
  UnseenTiles tiles(const PinholeCamera& view) const;

 private:
  std::vector<Extent> cells_;
};

}  // namespace vantage::planner::detail
