#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scoring/voxel/point_hierarchy.hpp"
#include "scoring/voxel/view_frustum.hpp"
#include "vantage/planner/advanced/visible_points.hpp"
#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage::planner::detail {

/// Traces from points to a camera's centre, from the end of each obstacle's band on.
class SegmentTracer {
 public:
  /// @param obstacles outlive it.
  SegmentTracer(PointsView points, std::span<const Obstacles> obstacles)
      : points_(points), obstacles_(obstacles) {}

  /// As `Scene::occluded` for packets of the points.
  void occluded(const Eigen::Vector3d& centre, std::span<const std::uint32_t> packets,
                std::span<const std::uint16_t> wanted, std::span<std::uint16_t> hidden);

 private:
  void trace(const Obstacles& obstacles, const Eigen::Vector3d& centre,
             std::span<const std::uint32_t> packets, std::span<const std::uint16_t> wanted,
             std::span<std::uint16_t> hidden);

  PointsView points_;
  std::span<const Obstacles> obstacles_;
  Points starts_;
  std::vector<std::uint32_t> in_order_;
  std::vector<std::uint16_t> open_, more_;  ///< not hidden so far, and hidden by the next obstacles
};

/// Counts what views from one place see of a set of points, packet by packet of it. Every packet is
/// traced once for all views. What is known so far bounds each view's count from above: a view that
/// has fallen below what is needed is out, and when all are out, no ray more is traced.
class ViewCounter {
 public:
  ViewCounter(const PointPackets& set, std::span<const Obstacles> obstacles,
              std::span<const PinholeCamera> views, std::span<const Score> needed);

  /// Keeps the points that are seen by views with exact counts: one place for each view.
  void keep(std::span<VisibleMasks> seen) { kept_ = seen; }

  void run(const StopToken& stop, std::span<ScoreBound> results);

 private:
  /// A view that still matters.
  struct View {
    std::size_t index;
    Score bound;                           ///< points that it may see, as far as is known
    std::vector<InView> blocks;            ///< by block; empty: the whole set is in view
    std::vector<std::uint16_t> seen = {};  ///< of the packets so far, if that is to be kept
  };
  /// A box of points that may be in view.
  struct FoundBox {
    std::size_t level, box;
    InView in_view;
  };
  using Masks = std::vector<std::uint16_t>;

  void admit(std::size_t index, ScoreBound& result);
  std::vector<InView> blocks_found() const;
  std::size_t next_batch_size() const;
  void look_at(std::span<const std::uint32_t> packets);
  Score find_in_view(const View& view, std::span<const std::uint32_t> packets,
                     std::uint16_t* in_view);
  void drop_hopeless(std::span<ScoreBound> results);

  const PointPackets& set_;
  SegmentTracer tracer_;
  std::span<const PinholeCamera> views_;
  std::span<const Score> needed_;
  std::span<VisibleMasks> kept_;
  std::vector<View> active_;
  std::vector<FoundBox> found_;  ///< of the view that is looked at
  std::size_t done_ = 0;         ///< packets

  // Of the packets of one batch: points that are no copies, that a view has in view (view by
  // view), that any view has in view, and that are hidden.
  Masks lanes_, in_view_, wanted_, hidden_;
  // Packets whose boxes do not say whether they are in view.
  std::vector<std::uint32_t> unsure_, unsure_at_;
  Masks unsure_masks_;
};

/// For each packet of `set.spread` the points that are in view.
std::vector<std::uint16_t> in_view_masks(const PointPackets& set, const PinholeCamera& view);

}  // namespace vantage::planner::detail
