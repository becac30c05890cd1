#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vantage/planner/expected_gain.hpp"
#include "vantage/planner/methods.hpp"
#include "vantage/planner/plan_options.hpp"
#include "vantage/planner/scored_views.hpp"
#include "vantage/planner/view_candidates.hpp"
#include "vantage/planner/view_constraints.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/state_grid.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

namespace planner::detail {
class PlannerContext;
}

/// What to plan for.
struct PlanRequest {
  Box work_area;
  Intrinsics intrinsics;           ///< of the movable camera
  DepthRange range = {};           ///< of the movable camera
  double voxel_size_m = 0.009375;  ///< the thesis' smallest voxel
  CandidateSet candidates = production_views();
  ViewConstraints constraints = {};
  Method method = VoxelMethod{};
  /// What the voxel method scores views by. The other methods' scores are their own; what their
  /// views are expected to gain is told beside them.
  ViewValue value = ViewValue::expected;
  ExpectedGainOptions gain = {};  ///< from what the expected gain is reckoned
  ServoOptions servo = {};
  PolishOptions polish = {};
  SearchOptions search = {};
  ViewSequenceOptions views = {};
  /// How the work area is classified, what hides from a new view, and how noisy depths are: its
  /// `noise` is the only noise model of a request, and a D435's unless you set your sensor's.
  VolumeOptions volume = {};

  /// `gain` over the floor of the constraints, which it is reckoned with.
  ExpectedGainOptions gain_options() const {
    ExpectedGainOptions options = gain;
    options.floor_z_m = constraints.floor_z_m;
    return options;
  }
};

/// One of the views to take, in their order.
struct NextView {
  RankedView view;  ///< its gain is of the shadow that the views before it left, too
  std::uint64_t revealed_voxels = 0;  ///< in sight, of the shadow that the views before it left
};

/// The result. With `stopped` other than none it is partial: the best of what was finished, not
/// polished if that was not; if not even the classification was finished, both grids are null.
struct Plan {
  PlanRequest request;  ///< as it was used
  std::string score_unit_name = {};
  double score_unit = 1;                         ///< what one step of a `Score` is
  std::vector<ScoredCandidate> candidates = {};  ///< by id, as scored for the first view
  std::vector<RankedView> ranked = {};           ///< the best of them, the first polished
  std::vector<ScoredStep> trace = {};            ///< the best one's servo iterations; if it was
                                                 ///< polished, last where that led
  std::vector<NextView> views = {};              ///< the first is `ranked.front()`
  std::size_t finished = 0;  ///< candidates: rejected, scored, surpassed or pruned
  /// As the given cameras left it, without what `VolumeOptions::filter` took away.
  std::shared_ptr<const StateGrid> classified = {};
  std::shared_ptr<const StateGrid> grid = {};  ///< with what all of `views` reveal
  StopReason stopped = StopReason::none;
  double classify_s = 0;
  double score_s = 0;
  /// The scorers and the scene that it was made with, which explanations go on using: immutable,
  /// and shared by copies of the plan. It may be large; without it (reset it) they are made again.
  std::shared_ptr<const planner::detail::PlannerContext> context = {};

  const RankedView* best() const { return ranked.empty() ? nullptr : &ranked.front(); }

  /// A score in `score_unit_name`.
  double in_units(Score score) const { return double(score) * score_unit; }

  /// Voxels as a volume, m³. Needs a grid.
  double volume_m3(std::uint64_t voxels) const {
    return double(voxels) * classified->geometry().voxel_volume_m3();
  }
};

/// Finds the view that a method scores best and, if more are asked for, the views to take after it:
/// classify, take away false shadow (`without_false_shadow`), generate candidates, reject those
/// that cannot be, search, polish the best.
///
/// Further views are chosen greedily by their joint gain. The voxel method's gain is submodular, so
/// that what k views reveal is at least 1 - 1/e of the most that any k of the candidates (and their
/// servo iterations) can (G. Nemhauser, L. Wolsey and M. Fisher, 1978); earlier gains bound later
/// ones, which is what makes it fast (M. Minoux, 1978). Other methods search again in the shadow
/// that the views before left. Each further view is polished, too, which only adds to its gain.
///
/// Runs in the caller's task arena; the plan is the same at any number of threads, but for times.
/// @throws Error bad_input as `classify`, `PinholeCamera`, `view_candidates`, `seen_world` and the
/// options' checks do.
VANTAGE_API Plan plan_next_view(const WorldModel& world, const PlanRequest& request,
                                const StopToken& stop = {});

/// The same for a work area that is classified already.
/// @param classified of `world`; never null.
VANTAGE_API Plan plan_next_view(const WorldModel& world,
                                std::shared_ptr<const StateGrid> classified,
                                const PlanRequest& request, const StopToken& stop = {});

/// How many candidates were rejected, by reason in words, in the order of `InvalidReason`.
VANTAGE_API std::vector<std::pair<std::string, std::size_t>> rejections_of(const Plan& plan);

/// What a candidate would reveal of one region of the shadow.
struct RegionGain {
  std::size_t region = 0;  ///< index into `ShadowRegions::list`
  std::uint64_t voxels = 0, revealed = 0;
};

/// Explains a candidate's score.
struct ViewExplanation {
  ViewCandidate candidate;
  InvalidReason rejected = InvalidReason::none;  ///< if there is one, the rest is empty
  std::string check_says = {};                   ///< but this, if a `ViewCheck` rejected it
  std::vector<ScoredStep> trace = {};  ///< as `Plan::trace`, each step with its exact score
  std::size_t best_step = 0;
  std::vector<ScoreTerm> terms = {};     ///< of the best step
  std::uint64_t revealed_voxels = 0;     ///< by the best step
  std::vector<RegionGain> regions = {};  ///< of which something is revealed; largest gain first
  std::string verdict = {};              ///< a sentence: why it won, or why it lost and by how much

  /// Why it was rejected, in words.
  std::string_view rejection() const { return rejection_text(rejected, check_says); }
};

/// Explains one candidate of a plan, by the plan's own scorers.
/// @param world that it was planned for; looked at only if the plan has no `context`.
/// @throws Error bad_input for an id that the plan does not have, or a plan without a grid.
VANTAGE_API ViewExplanation explain_view(const WorldModel& world, const Plan& plan, int id);

/// Explains several, in the order given; what they have in common is computed once.
/// @param stop ends it before the next one: then only those before are there.
/// @throws Error as `explain_view` does, before any is explained.
VANTAGE_API std::vector<ViewExplanation> explain_views(const WorldModel& world, const Plan& plan,
                                                       std::span<const int> ids,
                                                       const StopToken& stop = {});

/// What the voxel method gives for a pose: shadow voxels of `plan.classified` that it sees.
VANTAGE_API std::uint64_t revealed_voxels(const WorldModel& world, const Plan& plan,
                                          const Pose& T_world_cam);

}  // namespace vantage
