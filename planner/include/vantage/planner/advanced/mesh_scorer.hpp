#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "vantage/planner/advanced/shadow_view.hpp"
#include "vantage/planner/methods.hpp"
#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/advanced/visibility_mesh.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/state_grid.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

/// The work area as depth images alone show it (thesis 7.4.2 to 7.4.4).
struct SeenWorld {
  Box work_area;
  std::vector<VisibilityMesh>
      lattices;      ///< what the cameras saw through; none of those that saw none
  WorldModel known;  ///< known objects, enlarged, and static structures as they are; no cameras
  /// What is unseen without the false shadow, in voxels; null if it was not filtered.
  std::shared_ptr<const StateGrid> opened = {};
};

/// @param noise of the cameras' depths.
/// @throws Error bad_input if no camera has a depth image, or an object has no mesh, and as
/// `MeshMethod::check` and `StereoNoise::check` do.
VANTAGE_API SeenWorld seen_world(const WorldModel& world, const Box& work_area,
                                 const StereoNoise& noise, const MeshMethod& method = {});

/// The mesh method (thesis 7.4): the sum of (1 - v) · D^power over the pixels whose ray meets what
/// no camera saw through first, at depth D metres within the view's range. v is the surface's
/// "shadowness": the cosine at which the camera that made it looked at it, and 1 on known objects,
/// which hide what is behind them.
///
/// With `MeshWeight::volume` it is (1 - v) · (E³ - D³) instead, E being where the ray leaves the
/// work area or, to a voxel of its filter, the shadow, meets a known object or is at the range's
/// end. That is the volume in the pixel that may be revealed: views from different distances
/// compare by it.
///
/// Views are scored by images of `MeshMethod::image_width`, with the view's own field of view.
/// Every pixel's (1 - v) (D / far)^power is rounded to a multiple of 2^-35, so that sums are exact.
/// Also the servo's view: a pixel is shadow to it if v is below a half.
class VANTAGE_API MeshScorer final : public ViewScorer, public ShadowView {
 public:
  /// @param range of the views that are to be scored: `unit()` depends on it.
  /// @throws Error bad_input unless 0 <= depth_power <= 16 and 16 <= image_width <= 16384.
  MeshScorer(const SeenWorld& world, const DepthRange& range, double depth_power,
             int image_width = MeshMethod().image_width, MeshWeight weight = MeshWeight::depth);
  ~MeshScorer() override;

  std::string_view name() const noexcept override { return MeshMethod::kName; }
  double unit() const noexcept override;
  /// Metres to the power for `MeshWeight::depth`, cubic metres for `MeshWeight::volume`: of pixels'
  /// depths, so that both depend on the width of the image.
  std::string_view unit_name() const noexcept override;
  Score upper_bound(const PinholeCamera& view) const override;
  void score(std::span<const PinholeCamera> views, std::span<const Score> needed,
             std::span<ScoreBound> results, const StopToken& stop = {}) const override;
  using ViewScorer::score;
  std::vector<ScoreTerm> terms(const PinholeCamera& view) const override;
  std::optional<ShadowBounds> shadow_bounds(const PinholeCamera& view) const override;

  /// With the score, if the view's image is as wide as those that views are scored by.
  ShadowObservation observe(const PinholeCamera& view,
                            const std::optional<ExtremePoints>& expected) const override;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace vantage
