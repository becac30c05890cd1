#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>

#include "search/candidate_group.hpp"
#include "vantage/planner/advanced/mesh_scorer.hpp"
#include "vantage/planner/advanced/shadow_scorer.hpp"
#include "vantage/planner/advanced/voxel_scorer.hpp"
#include "vantage/planner/plan.hpp"

namespace vantage::planner::detail {

/// All that a plan needs besides the candidates, made from a classified grid.
class PlannerContext {
 public:
  /// @param candidates how many there are to be.
  /// @throws Error as `plan_next_view` does, but for the candidates.
  PlannerContext(const WorldModel& world, std::shared_ptr<const StateGrid> grid,
                 const PlanRequest& request, std::size_t candidates)
      : PlannerContext(world, PlanningScene(world, std::move(grid), request.volume.occluders),
                       request, candidates) {}

  /// @param scene made from `world`.
  PlannerContext(const WorldModel& world, const PlanningScene& scene, const PlanRequest& request,
                 std::size_t candidates);

  const std::shared_ptr<const ViewScorer>& scorer() const { return context_.scorer; }
  const VoxelScorer& voxels() const { return *voxels_; }
  bool by_voxels() const { return context_.scorer == voxels_; }  ///< the method is `voxel`
  const PinholeCamera& camera() const { return context_.camera; }
  const SearchTools& search_tools() const { return context_; }

  /// The best of all candidates; of a shortlist, where the method has one.
  SearchResult search(std::span<const ViewCandidate> candidates, const StopToken& stop) const;

  /// As `ViewSearch::trace` does.
  std::vector<ScoredStep> trace(const ViewCandidate& candidate, const StopToken& stop = {}) const;
  const ViewPolisher* polisher() const { return polisher_.get(); }  ///< null: nothing is polished
  std::size_t polished_views() const { return polished_views_; }

 private:
  ViewSearch search_by(std::shared_ptr<const ViewScorer> scorer, int ranked) const;

  SearchOptions options_;
  int shortlist_ = 0;
  std::shared_ptr<const VoxelScorer> voxels_;
  std::shared_ptr<const ViewScorer> cheap_;  ///< null: no shortlist
  SearchTools context_;
  std::size_t polished_views_;
  std::shared_ptr<const ViewPolisher> polisher_;
};

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

}  // namespace vantage::planner::detail
