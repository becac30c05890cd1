#include "classify/camera_visibility.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <optional>

namespace vantage::volume::detail {
namespace {

/// Objects hide what is behind them at whatever distance from the camera they are.
constexpr DepthRange kHidingDepths = {1e-6, 1e9};

/// Which parts of the grid a camera sees past or through boxes in which something has changed.
class ChangedView {
 public:
  ChangedView(const PinholeCamera& camera, std::span<const Extent> changed)
      : projector_({camera.intrinsics(), camera.T_world_cam(), kHidingDepths}) {
    for (const Extent& box : changed) {
      const BoxInView view = projector_.project(box, projector_.margin_m(box));
      if (view.coverage != Coverage::none) boxes_.push_back(view);
    }
  }

  bool empty() const { return boxes_.empty(); }

  /// Whether a line of sight to a point in view of `extent` may meet one of the boxes: it has one
  /// pixel, and what it meets is nearer than its end.
  bool concerns(const Extent& extent) const {
    const BoxInView view = projector_.project(extent, projector_.margin_m(extent));
    if (view.coverage == Coverage::none) return false;
    return std::any_of(boxes_.begin(), boxes_.end(), [&](const BoxInView& box) {
      const ImageRect &a = view.rect, &b = box.rect;
      return box.z_min <= view.z_max && a.u0 <= b.u1 && b.u0 <= a.u1 && a.v0 <= b.v1 &&
             b.v0 <= a.v1;
    });
  }

 private:
  BoxProjector projector_;
  std::vector<BoxInView> boxes_;
};

class SightTracer {
 public:
  SightTracer(const PinholeCamera& camera, const KnownSpace& known, CameraVisibility& sight)
      : camera_(camera), projector_(camera), known_(known), contours_(camera), sight_(sight) {
    known.occluders.add_contours(camera, contours_);
    contours_.finish();
  }

  void trace(std::size_t chunk) {
    descend(
        known_.frame.layout.blocks_in_chunk(chunk),
        [&](const CellRange& blocks) { return decide(blocks); },
        [&](const Eigen::Vector3i& block) { trace_block(block); });
  }

  /// Leaves what does not concern the change as it is.
  void trace(std::size_t chunk, const ChangedView& changed) {
    const auto decide_if_concerned = [&](const CellRange& blocks) {
      const auto voxels = known_.frame.layout.voxels_in(blocks);
      return !changed.concerns(known_.frame.extent_of_centres(voxels)) || decide(blocks);
    };
    descend(known_.frame.layout.blocks_in_chunk(chunk), decide_if_concerned,
            [&](const Eigen::Vector3i& block) { trace_block(block); });
  }

 private:
  bool decide(const CellRange& blocks) {
    const BoxInView box = project(blocks);
    if (box.coverage == Coverage::none) return true;
    if (box.coverage == Coverage::some) return false;
    const std::optional<bool> hidden = hidden_as_one(blocks, box);
    if (!hidden) return false;
    blocks.for_each([&](const Eigen::Vector3i& block) {
      const std::size_t index = known_.frame.layout.index(block);
      sight_.covered.set_all(index);
      *hidden ? sight_.clear.set(index, {}) : sight_.clear.set_all(index);
    });
    return true;
  }

  void trace_block(const Eigen::Vector3i& block) {
    const BlockLayout& layout = known_.frame.layout;
    const std::size_t index = layout.index(block);
    const BlockBits covered = in_view(block, layout.inside(index));
    sight_.covered.set(index, covered);
    if (covered.none()) return;
    if (known_.occluders.empty()) return sight_.clear.set(index, covered);
    const BlockBits open = covered & ~known_.solid.bits(index);
    sight_.clear.set(index, open.none() ? BlockBits{} : not_hidden(block, open));
  }

  BoxInView project(const CellRange& blocks) const {
    const Extent extent = known_.frame.extent_of_centres(known_.frame.layout.voxels_in(blocks));
    return projector_.project(extent, projector_.margin_m(extent));
  }

  /// Whether all voxels of a range that is in view are hidden, or none; nothing if that may differ.
  std::optional<bool> hidden_as_one(const CellRange& blocks, const BoxInView& box) const {
    if (known_.occluders.empty()) return false;
    if (known_.surface_in(blocks) || !contours_.clear_before(box)) return std::nullopt;
    const CellRange voxels = known_.frame.layout.voxels_in(blocks);
    if (known_.solid.test(voxels.first)) return true;  // all of it is: no surface goes through
    // One ray would do. The eight corners are one packet, and a ray that slips through between
    // triangles that meet in a vertex does not go unnoticed.
    Eigen::Vector3i corners[8];
    Points centres(8);
    for (std::size_t c = 0; c < 8; ++c) {
      for (int axis = 0; axis < 3; ++axis) {
        corners[c][axis] = (c >> axis & 1) != 0 ? voxels.last[axis] - 1 : voxels.first[axis];
      }
      centres.set(c, known_.frame.centre(corners[c]));
    }
    std::array<std::uint8_t, 8> hidden{};
    known_.occluders.hidden(corners, centres, camera_.centre(), hidden);
    if (!std::all_of(hidden.begin(), hidden.end(), [&](auto h) { return h == hidden[0]; })) {
      return std::nullopt;
    }
    return hidden[0] != 0;
  }

  BlockBits in_view(const Eigen::Vector3i& block, const BlockBits& inside) const {
    if (project({block, block.array() + 1}).coverage == Coverage::all) return inside;
    const BlockVoxels voxels(known_.frame, block, inside);
    std::uint8_t in_view[kBlockVoxels];
    camera_.in_view(voxels.centres(), {in_view, voxels.size()});
    return voxels.where(in_view, 1);
  }

  /// Which voxels of a block are not hidden: by octants where that is proven, the rest one by one.
  BlockBits not_hidden(const Eigen::Vector3i& block, const BlockBits& which) const {
    BlockBits provable[8], ends;
    for (int o = 0; o < 8; ++o) {
      const BlockBits voxels = which & BlockBits::octant(o);
      if (voxels.none() || !one_answer(block, o)) continue;
      provable[o] = voxels;
      ends.set(voxels.first()), ends.set(voxels.last());
    }
    BlockBits clear, rest = which;
    const BlockBits clear_ends = ends.none() ? BlockBits{} : not_hidden_one_by_one(block, ends);
    for (const BlockBits& voxels : provable) {
      if (voxels.none()) continue;
      const bool first = clear_ends.test(voxels.first());
      if (first != clear_ends.test(voxels.last())) continue;
      rest &= ~voxels;
      if (first) clear |= voxels;
    }
    return rest.none() ? clear : clear | not_hidden_one_by_one(block, rest);
  }

  /// Whether all voxels in view of an octant are hidden, or none.
  bool one_answer(const Eigen::Vector3i& block, int octant) const {
    if ((known_.surface_octants[known_.frame.layout.index(block)] >> octant & 1) != 0) return false;
    const Eigen::Vector3i half(octant >> 2, octant >> 1 & 1, octant & 1);
    const Eigen::Vector3i first = kBlockSide * block + kOctantSide * half;
    const CellRange voxels{first, first.array() + kOctantSide};
    const Extent extent =
        known_.frame.extent_of_centres(voxels.within(known_.frame.layout.voxels()));
    return contours_.clear_before(projector_.project(extent, projector_.margin_m(extent)));
  }

  BlockBits not_hidden_one_by_one(const Eigen::Vector3i& block, const BlockBits& which) const {
    const BlockVoxels list(known_.frame, block, which);
    Eigen::Vector3i voxels[kBlockVoxels];
    for (std::size_t i = 0; i < list.size(); ++i) voxels[i] = list.voxel(i);
    std::uint8_t hidden[kBlockVoxels];
    known_.occluders.hidden({voxels, list.size()}, list.centres(), camera_.centre(),
                            {hidden, list.size()});
    return list.where(hidden, 0);
  }

  const PinholeCamera& camera_;
  BoxProjector projector_;
  const KnownSpace& known_;
  ContourMap contours_;
  CameraVisibility& sight_;
};

}  // namespace

bool KnownSpace::surface_in(const CellRange& blocks) const {
  bool any = false;
  blocks.for_each([&](const Eigen::Vector3i& block) {
    any = any || surface_octants[frame.layout.index(block)] != 0;
  });
  return any;
}

CameraVisibility trace_sight(const PinholeCamera& camera, const KnownSpace& known,
                             const StopToken& stop) {
  CameraVisibility sight(known.frame.layout);
  SightTracer tracer(camera, known, sight);
  tbb::parallel_for(std::size_t(0), known.frame.layout.chunk_count(), [&](std::size_t chunk) {
    if (stop.stop_requested()) return;
    tracer.trace(chunk);
    stop.advance(1);
  });
  return sight;
}

void retrace_sight(const PinholeCamera& camera, const KnownSpace& known,
                   std::span<const Extent> changed, const StopToken& stop,
                   CameraVisibility& sight) {
  const ChangedView view(camera, changed);
  if (view.empty()) return;
  SightTracer tracer(camera, known, sight);
  tbb::parallel_for(std::size_t(0), known.frame.layout.chunk_count(), [&](std::size_t chunk) {
    if (stop.stop_requested()) return;
    tracer.trace(chunk, view);
    stop.advance(1);
  });
}

}  // namespace vantage::volume::detail
