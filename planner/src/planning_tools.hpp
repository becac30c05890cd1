#pragma once

#include <memory>

#include "site.hpp"
#include "vantage/planner/plan.hpp"
#include "vantage/planner/voxel_scorer.hpp"

namespace vantage::detail {

/// All that a plan needs besides the candidates, made from a classified grid.
class PlanningTools {
 public:
  /// @throws Error as `plan_next_view` does, but for the candidates.
  PlanningTools(const WorldModel& world, std::shared_ptr<const StateGrid> grid,
                const PlanRequest& request)
      : PlanningTools(world, PlanningScene(world, std::move(grid), request.volume.occluders),
                      request) {}

  /// @param scene made from `world`.
  PlanningTools(const WorldModel& world, const PlanningScene& scene, const PlanRequest& request);

  const std::shared_ptr<const ViewScorer>& scorer() const { return tools_.scorer; }
  const VoxelScorer& voxels() const { return *voxels_; }
  bool by_voxels() const { return tools_.scorer == voxels_; }  ///< the method is `voxel`
  const PinholeCamera& camera() const { return tools_.camera; }
  const SearchTools& search_tools() const { return tools_; }
  ViewSearch search() const;

 private:
  SearchOptions options_;
  std::shared_ptr<const VoxelScorer> voxels_;
  SearchTools tools_;
};

}  // namespace vantage::detail
