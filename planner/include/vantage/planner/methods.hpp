#pragma once

#include <memory>
#include <string>
#include <vector>

#include "vantage/planner/advanced/mesh_scorer.hpp"
#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// Which method scores the views, and how.
struct MethodOptions {
  std::string name = "voxel";
  double depth_power = 6;  ///< of `shadow` and `mesh`; 0, 3 and 6 are the thesis' D0, D3 and D6
  MeshOptions mesh = {};

  /// @throws Error bad_input for a name that is none of `method_names()`, and a power that is not
  /// from 0 to 16, and as `MeshOptions::check` does.
  VANTAGE_API void check() const;
};

/// The names that `make_view_scorer` knows.
VANTAGE_API const std::vector<std::string>& method_names();

/// A method by its name.
/// @param scene made from `world`.
/// @param range of the views that are to be scored.
/// @throws Error as `MethodOptions::check` does, for `mesh` also as `seen_world` does.
VANTAGE_API std::unique_ptr<const ViewScorer> make_view_scorer(const MethodOptions& options,
                                                               const PlanningScene& scene,
                                                               const WorldModel& world,
                                                               const DepthRange& range);

}  // namespace vantage
