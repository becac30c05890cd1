#pragma once

#include <Eigen/Core>
#include <memory>

#include "vantage/planner/mesh_scorer.hpp"
#include "vantage/planner/plan.hpp"
#include "vantage/planner/shadow_scorer.hpp"

namespace vantage::detail {

/// What the mesh method plans with.
struct MeshTools {
  std::shared_ptr<const MeshScorer> scorer;
  std::shared_ptr<const ViewScorer> cheap;  ///< picks the shortlist; null if there is to be none
  std::shared_ptr<const ShadowView> cheap_sight;  ///< what the servo looks at then
  Eigen::Vector3d middle_of_unseen;               ///< which the servo measures distances to
};

/// @param views candidates and their servo iterations; of many, there is to be a shortlist.
/// @throws Error as `seen_world` does.
MeshTools mesh_tools(const WorldModel& world, const Box& work_area, const PlanRequest& request,
                     std::size_t views);

}  // namespace vantage::detail
