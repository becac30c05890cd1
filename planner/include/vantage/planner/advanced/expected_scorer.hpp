#pragma once

#include <memory>
#include <span>
#include <vector>

#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/expected_gain.hpp"
#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

/// Scores views by their expected gain: the volume of the shadow voxels that the movable camera
/// will turn to free or occupied, each counted by the probability that it does.
///
/// The voxel method asks whether the centre of a voxel is in sight. For those that are (384 of
/// them, evenly spread, stand for all), this asks further, by rays through them:
/// - Is there a reading at its pixel? What the ray meets behind it first must return light to both
/// imagers and
///   lie within the range, not too slanted, lit by the projector (`StereoSensor`). That is looked
///   for among the known geometry, the measured voxels, and what the given depth images show beyond
///   the work area. Where there is none of it, the share of the given images' pixels that have a
///   reading counts, apart for rays that meet the floor at z = 0 and for those that do not.
/// - Is something unknown in the way, or is the voxel inside it? Behind the front of a thing that
/// was
///   measured and that no model knows, shadow is solid with a probability that falls with the
///   distance from the front, by how wide the thing looks (`ExpectedGainOptions::unknown_depth`);
///   several cameras that look at fronts before the same voxel add up, as in a visual hull.
///   Elsewhere in the unseen volume, unknown things are as dense as in the volume that the given
///   cameras see through: light goes exp(-hazard · length) of the way.
/// What is within a measured surface's thickness behind its front counts as measured with it.
///
/// Every voxel's probability is rounded to a multiple of 1/255, so that sums are exact, and none is
/// above 1: 255 times the number of voxels in sight is a certified upper bound, and a view in which
/// they are too few is never looked at closer. With an ideal sensor where nothing unknown was
/// measured, the expected gain is the bound.
///
/// Unlike other scorers it may split the rays of one view over the caller's task arena; scores are
/// the same at any number of threads.
class VANTAGE_API ExpectedScorer final : public ViewScorer {
 public:
  /// @param scene made from `world`.
  /// @param volume how `scene`'s grid was classified: its noise is that of the given depths.
  /// @throws Error bad_input as the options' checks do.
  ExpectedScorer(const PlanningScene& scene, const WorldModel& world, const VolumeOptions& volume,
                 const ExpectedGainOptions& options);
  ~ExpectedScorer() override;

  std::string_view name() const noexcept override { return "expected gain"; }
  double unit() const noexcept override;
  std::string_view unit_name() const noexcept override { return "m³"; }
  Score upper_bound(const PinholeCamera& view) const override;
  void score(std::span<const PinholeCamera> views, std::span<const Score> needed,
             std::span<ScoreBound> results, const StopToken& stop = {}) const override;
  using ViewScorer::score;
  std::vector<ScoreTerm> terms(const PinholeCamera& view) const override;
  bool shares_rays() const noexcept override { return true; }

  /// The score with an interval around it.
  GainEstimate estimate(const PinholeCamera& view) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace vantage
