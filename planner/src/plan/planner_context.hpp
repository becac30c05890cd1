#pragma once

#include <memory>
#include <span>
#include <vector>

#include "plan/method_tools.hpp"
#include "search/candidate_group.hpp"
#include "vantage/planner/advanced/view_polisher.hpp"
#include "vantage/planner/advanced/view_search.hpp"
#include "vantage/planner/plan.hpp"

namespace vantage::planner::detail {

/// All that a plan needs besides the candidates, made from a classified grid. Immutable;
/// thread-safe.
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
  const VoxelScorer& voxels() const { return *tools_.voxels; }
  const ExpectedScorer& gain() const { return *tools_.gain; }
  bool by_voxels() const { return tools_.scorer == tools_.voxels; }  ///< `voxel`, by the bound
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
  MethodTools tools_;
  SearchTools context_;
  std::size_t polished_views_;
  std::shared_ptr<const ViewPolisher> polisher_;
};

}  // namespace vantage::planner::detail
