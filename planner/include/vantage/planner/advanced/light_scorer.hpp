#pragma once

#include <memory>
#include <vector>

#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/advanced/visible_points.hpp"
#include "vantage/planner/methods.hpp"
#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

namespace planner::detail {
struct SurfaceSamples;
}

/// The light method (thesis 7.1): the cameras are lamps, and a view is worth the area of the known
/// objects' and static structures' surfaces in the work area that no camera lights and it would.
///
/// The thesis never built it, because of its flaw: the far side of a known object counts as dark
/// although it is known, and unknown objects cast no shadow. It is here to show this.
class VANTAGE_API LightScorer final : public ViewScorer {
 public:
  LightScorer(const PlanningScene& scene, const WorldModel& world);

  std::string_view name() const noexcept override { return LightMethod::kName; }
  double unit() const noexcept override { return area_per_point_m2_; }
  std::string_view unit_name() const noexcept override { return "m²"; }
  Score upper_bound(const PinholeCamera& view) const override;
  void score(std::span<const PinholeCamera> views, std::span<const Score> needed,
             std::span<ScoreBound> results, const StopToken& stop = {}) const override;
  using ViewScorer::score;
  std::vector<ScoreTerm> terms(const PinholeCamera& view) const override;
  bool shares_rays() const noexcept override { return true; }

 private:
  LightScorer(const planner::detail::SurfaceSamples& samples, const WorldModel& world);

  double area_per_point_m2_;
  VisiblePoints dark_;
};

}  // namespace vantage
