#pragma once

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

/// Counts which of a fixed set of points views see: inside the image and the depth range, and past
/// everything in a scene. What hides a point depends on the camera's centre only, so that views
/// with one centre share their rays.
///
/// Immutable; every method is thread-safe and runs in the calling thread.
class VANTAGE_API VisiblePoints {
 public:
  /// @throws Error bad_input for a point that is not finite.
  VisiblePoints(Points points, std::shared_ptr<const Scene> occluders);
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

  /// 1 or 0 for every point, in the order in which they were given.
  std::vector<std::uint8_t> visible(const PinholeCamera& view) const;

  /// Points inside the image and the depth range, hidden or not.
  std::uint64_t count_in_view(const PinholeCamera& view) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace vantage
