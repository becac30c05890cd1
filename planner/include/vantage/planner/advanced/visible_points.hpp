#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/points.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// Points that a view sees: bit l of `masks[i]` for point l of packet `packets[i]` of
/// `VisiblePoints::ordered_points`.
struct VisibleMasks {
  std::span<const std::uint32_t> packets;
  std::vector<std::uint16_t> masks;

  /// Calls `visit(point)` for every one of them.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t i = 0; i < masks.size(); ++i) {
      for (unsigned rest = masks[i]; rest != 0; rest &= rest - 1) {
        visit(std::size_t(packets[i]) * kPacketWidth + std::size_t(std::countr_zero(rest)));
      }
    }
  }
};

/// How deep behind a surface points count as seen with it, metres: max(least_m, at_1m · distance²),
/// by the distance of the camera.
struct SurfaceBand {
  double least_m = 0;
  double at_1m = 0;
};

/// What hides points.
struct Obstacles {
  std::shared_ptr<const Scene> scene;
  SurfaceBand band = {};
};

/// Counts which of a fixed set of points views see: inside the image and the depth range, and past
/// everything in a scene. What hides a point depends on the camera's centre only, so that views
/// with one centre share their rays.
///
/// Immutable; every method is thread-safe and runs in the calling thread.
class VANTAGE_API VisiblePoints {
 public:
  /// @throws Error bad_input for a point that is not finite.
  VisiblePoints(Points points, std::shared_ptr<const Scene> occluders);
  VisiblePoints(Points points, std::vector<Obstacles> obstacles);
  ~VisiblePoints();
  VisiblePoints(VisiblePoints&&) noexcept;
  VisiblePoints& operator=(VisiblePoints&&) noexcept;

  std::size_t size() const noexcept;

  /// As `ViewScorer::upper_bound`: from the view's borders alone, without a ray.
  Score upper_bound(const PinholeCamera& view) const;

  /// As `ViewScorer::score`.
  /// @throws Error bad_input for spans of different sizes, and for views with different centres.
  void count(std::span<const PinholeCamera> views, std::span<const Score> needed,
             std::span<ScoreBound> results, const StopToken& stop) const;

  /// The same; and of the views whose counts are exact, the points that they see, as `visible` has
  /// them but packet by packet: for whoever weighs them.
  /// @param seen one for each view; empty where the count is not exact, or 0.
  void count(std::span<const PinholeCamera> views, std::span<const Score> needed,
             std::span<ScoreBound> results, std::span<VisibleMasks> seen,
             const StopToken& stop) const;

  /// The points in the order of their packets.
  PointsView ordered_points() const noexcept;

  /// 1 or 0 for every point, in the order in which they were given.
  std::vector<std::uint8_t> visible(const PinholeCamera& view) const;

  /// Points inside the image and the depth range, hidden or not.
  std::uint64_t count_in_view(const PinholeCamera& view) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace vantage
