#pragma once

#include <cstdint>
#include <vector>

#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/advanced/visible_points.hpp"
#include "vantage/planner/methods.hpp"
#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/export.hpp"

namespace vantage {

/// The voxel method (thesis 7.2.5): a view is worth the volume of the shadow voxels whose centres
/// it would see past everything occupied. Shadow itself hides nothing.
class VANTAGE_API VoxelScorer final : public ViewScorer {
 public:
  explicit VoxelScorer(const PlanningScene& scene);

  std::string_view name() const noexcept override { return VoxelMethod::kName; }
  double unit() const noexcept override { return voxel_volume_m3_; }
  std::string_view unit_name() const noexcept override { return "m³"; }
  Score upper_bound(const PinholeCamera& view) const override;
  void score(std::span<const PinholeCamera> views, std::span<const Score> needed,
             std::span<ScoreBound> results, const StopToken& stop = {}) const override;
  using ViewScorer::score;
  std::vector<ScoreTerm> terms(const PinholeCamera& view) const override;
  bool shares_rays() const noexcept override { return true; }

  /// 1 or 0 for every shadow voxel, in the order of `StateGrid::centres`.
  std::vector<std::uint8_t> revealed(const PinholeCamera& view) const;

 private:
  double voxel_volume_m3_;
  VisiblePoints points_;
};

}  // namespace vantage
