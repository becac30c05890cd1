#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/advanced/shadow_view.hpp"
#include "vantage/planner/methods.hpp"
#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/export.hpp"

namespace vantage {

/// The shadow method (thesis 7.3): the sum of D^power over the pixels whose ray meets shadow first,
/// at depth D metres within the camera's range.
///
/// Every pixel's (D / far)^power is rounded to a multiple of 2^-35, so that sums are exact.
/// Also the servo's view: both look at the same image.
class VANTAGE_API ShadowScorer final : public ViewScorer, public ShadowView {
 public:
  /// @param range of the views that are to be scored: `unit()` depends on it.
  /// @throws Error bad_input unless 0 <= depth_power <= 16.
  ShadowScorer(const PlanningScene& scene, const DepthRange& range, double depth_power);
  ~ShadowScorer() override;

  std::string_view name() const noexcept override { return ShadowMethod::kName; }
  double unit() const noexcept override;
  std::string_view unit_name() const noexcept override { return "m^power · pixels"; }
  Score upper_bound(const PinholeCamera& view) const override;
  Score upper_bound_if_needed(const PinholeCamera& view, Score needed) const override;
  void score(std::span<const PinholeCamera> views, std::span<const Score> needed,
             std::span<ScoreBound> results, const StopToken& stop = {}) const override;
  using ViewScorer::score;
  std::vector<ScoreTerm> terms(const PinholeCamera& view) const override;
  std::optional<ShadowBounds> shadow_bounds(const PinholeCamera& view) const override;
  ShadowObservation observe(const PinholeCamera& view,
                            const std::optional<ExtremePoints>& expected) const override;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace vantage
