#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>

#include "vantage/planner/advanced/expected_scorer.hpp"
#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/advanced/shadow_view.hpp"
#include "vantage/planner/advanced/voxel_scorer.hpp"
#include "vantage/planner/plan.hpp"
#include "vantage/planner/view_scorer.hpp"

namespace vantage::planner::detail {

/// What a method brings to a plan.
struct MethodTools {
  std::shared_ptr<const ViewScorer> scorer;
  std::shared_ptr<const VoxelScorer> voxels;     ///< what views reveal; may be the scorer itself
  std::shared_ptr<const ExpectedScorer> gain;    ///< what of that to expect; may be the scorer, too
  std::shared_ptr<const ShadowView> sight;       ///< what the servo looks at; null if there is none
  Eigen::Vector3d shadow_centre;                 ///< which servo and polishing measure distances to
  std::shared_ptr<const ViewScorer> cheap = {};  ///< picks a shortlist; null if there is to be none
  int shortlist = 0;                             ///< its length
};

/// @param scene made from `world`.
/// @param candidates how many there are to be: of many, the mesh method scores a shortlist.
/// @throws Error as `seen_world` does.
MethodTools method_tools(const WorldModel& world, const PlanningScene& scene,
                         const PlanRequest& request, std::size_t candidates);

}  // namespace vantage::planner::detail
