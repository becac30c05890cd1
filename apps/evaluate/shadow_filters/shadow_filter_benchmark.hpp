#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "evaluate/planning/planning_cell.hpp"
#include "metrics/planning/shadow_filter_evaluation.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/volume/advanced/visibility.hpp"

namespace vantage {

/// What `vantage evaluate shadow-filters` was asked for: every combination is a filter.
struct ShadowFilterOptions {
  std::vector<double> offsets_sigmas{0, 1, 2, 3, 4, 6};
  std::vector<int> openings_voxels{0, 1, 2};
  std::vector<double> min_cm3{0, 1, 10};
  bool classified = false;  ///< the grid comes from `classify`, not carved by visibility meshes:
                            ///< then offsets make no difference, and the first one is all
  int step_px = 8;
  DepthHoles holes = DepthHoles::fill;
  double voxel_size_m = 0.0047;
};

/// The combinations, in the order of the lists; no filter comes first if the lists contain it.
std::vector<ShadowFilter> filters_of(const ShadowFilterOptions& options);

/// Carves the cell by what its cameras measured, filters the shadow in every way, and compares it
/// with the ground truth. Runs in the caller's task arena; the same at any number of threads. The
/// result is meaningless if `stop` was cancelled.
/// @throws Error bad_input for a cell without depth images, and as `visibility_lattice`, `carve`
/// and the filters do.
FilteredScene evaluate_shadow_filters(const PlanningCell& cell, const ShadowFilterOptions& options,
                                      const StopToken& stop);

}  // namespace vantage
