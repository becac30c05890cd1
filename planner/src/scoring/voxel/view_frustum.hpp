#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "scoring/voxel/point_hierarchy.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage::planner::detail {

/// How much of a box is in view, for certain.
enum class InView : std::uint8_t { none, some, all };

/// A point p is inside where x p.x + y p.y + z p.z + offset >= 0.
struct ViewPlane {
  double x, y, z, offset;
  double margin;  ///< by how much rounding may change that
};

/// What a camera has in view, as six planes, for boxes by the dozen: certified as
/// `BoxProjector::project` is, by the same planes and margin.
class ViewFrustum {
 public:
  /// @param largest_coordinate of the points that the boxes are around.
  ViewFrustum(const PinholeCamera& view, double largest_coordinate);

  /// Eight boxes from `first` on.
  std::array<InView, kBlocksPerParent> test(const BoxLanes& boxes, std::size_t first) const;

 private:
  std::array<ViewPlane, 6> planes_;
};

/// Calls `visit(level, box, in_view)` for boxes that together hold all points: of the highest level
/// at which a box is in view as a whole or not at all, or of level 0. Those out of view are named
/// before the rest is looked at closer. Ends when `visit` returns false.
template <class Visit>
void for_each_box(const PointPackets& set, const ViewFrustum& frustum, const Visit& visit) {
  const auto descend = [&](const auto& self, std::size_t level, std::size_t first) -> bool {
    const auto in_view = frustum.test(set.levels[level], first);
    const std::size_t count = std::min(kBlocksPerParent, set.levels[level].size - first);
    for (std::size_t i = 0; i < count; ++i) {
      if (in_view[i] == InView::none && !visit(level, first + i, InView::none)) return false;
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (in_view[i] == InView::none) continue;
      const bool closer = in_view[i] == InView::some && level > 0;
      const bool go_on = closer ? self(self, level - 1, (first + i) * kBlocksPerParent)
                                : visit(level, first + i, in_view[i]);
      if (!go_on) return false;
    }
    return true;
  };
  if (set.size > 0) descend(descend, set.levels.size() - 1, 0);
}

}  // namespace vantage::planner::detail
