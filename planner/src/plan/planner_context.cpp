#include "plan/planner_context.hpp"

#include <algorithm>

#include "search/two_stage_search.hpp"

namespace vantage::planner::detail {

PlannerContext::PlannerContext(const WorldModel& world, const PlanningScene& scene,
                               const PlanRequest& request, std::size_t candidates)
    : options_(request.search),
      tools_(method_tools(world, scene, request, candidates)),
      context_{tools_.scorer, nullptr, nullptr,
               PinholeCamera(request.intrinsics, Pose(), request.range, "movable camera"),
               Utility(request.search.travel)},
      polished_views_(std::size_t(request.polish.views)) {
  context_.validity =
      std::make_shared<const ViewValidityChecker>(request.constraints, scene, request.range);
  if (request.servo.iterations > 0) {
    context_.servo = std::make_shared<const ServoRefiner>(
        tools_.sight, context_.validity, context_.camera, tools_.shadow_centre, request.servo);
  }
  if (request.polish.views > 0) {
    polisher_ = std::make_shared<const ViewPolisher>(context_.scorer, context_.validity,
                                                     context_.camera, tools_.shadow_centre,
                                                     request.polish, request.search.travel);
  }
}

SearchResult PlannerContext::search(std::span<const ViewCandidate> candidates,
                                    const StopToken& stop) const {
  const ViewSearch exact = search_by(context_.scorer, options_.ranked);
  if (tools_.cheap == nullptr) return exact.run(candidates, stop);
  const int shortlist = std::max(tools_.shortlist, options_.ranked);
  return ShortlistSearch(search_by(tools_.cheap, shortlist), exact, options_.ranked, shortlist)
      .run(candidates, stop);
}

std::vector<ScoredStep> PlannerContext::trace(const ViewCandidate& candidate,
                                              const StopToken& stop) const {
  return search_by(context_.scorer, options_.ranked).trace(candidate, stop);
}

ViewSearch PlannerContext::search_by(std::shared_ptr<const ViewScorer> scorer, int ranked) const {
  SearchOptions options = options_;
  options.ranked = ranked;
  return {std::move(scorer), context_.validity, context_.servo, context_.camera, options};
}

}  // namespace vantage::planner::detail
