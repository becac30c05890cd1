#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vantage/planner/view_candidates.hpp"
#include "vantage/raycore/api.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/state_grid.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

/// What to plan for.
struct PlanRequest {
  Box work_area;
  Intrinsics intrinsics;             ///< of the movable camera
  DepthRange range = {};             ///< of the movable camera
  double voxel_size_m = 0.009375;    ///< the thesis' smallest voxel
  std::vector<double> radii_m = {};  ///< of the half-spheres; empty: `default_radii_m`
  int candidates_per_half_sphere = 20;
  std::optional<Reach> reach = {};
  VolumeOptions volume = {};  ///< how the work area is classified, and what hides from a new view
};

/// A candidate and what came of it.
struct ScoredCandidate {
  ViewCandidate view;
  std::optional<std::string> rejected;           ///< the reason, if it is not feasible
  std::optional<std::uint64_t> revealed_voxels;  ///< nothing if rejected, or not reached in time
};

/// The answer. With `stopped` other than none it is partial: the best of what was finished; if not
/// even the classification was, both grids are null.
struct Plan {
  PlanRequest request;                          ///< with the radii that were used
  std::vector<ScoredCandidate> candidates;      ///< by id
  std::optional<std::size_t> best;              ///< index; nothing if no candidate was scored
  std::shared_ptr<const StateGrid> classified;  ///< as the given cameras left it
  std::shared_ptr<const StateGrid> grid;        ///< with what the best view reveals
  StopReason stopped = StopReason::none;
  double classify_s = 0;
  double score_s = 0;

  /// Volume that a candidate would newly observe, m³.
  VANTAGE_API std::optional<double> newly_observed_volume_m3(std::size_t candidate) const;
};

/// Finds the view that reveals the most shadow: classify, generate candidates, score each with the
/// voxel method. The best score wins, ties go to the lower id.
///
/// Runs in the caller's task arena; the plan is the same at any number of threads, but for times.
/// @throws Error bad_input as `classify`, `PinholeCamera` and `half_sphere_candidates` do.
VANTAGE_API Plan plan_next_view(const WorldModel& world, const PlanRequest& request,
                                const StopToken& stop = {});

}  // namespace vantage
