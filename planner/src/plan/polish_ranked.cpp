#include "plan/polish_ranked.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace vantage::planner::detail {
namespace {

/// Takes the view where polishing led, if that is better on the camera's own image, too.
void polish_one(const PlannerContext& context, RankedView& view, const StopToken& stop) {
  std::vector<PolishStep> steps = context.polisher()->path(view.T_world_cam, stop);
  if (steps.empty()) return;
  const SearchTools& search = context.search_tools();
  const PinholeCamera camera = search.camera.moved_to(steps.back().T_world_cam);
  const std::uint64_t share = search.utility.share(camera.centre());
  const ScoreBound score = search.scorer->score(camera, stop);
  const Score utility = Utility::of(score.score, share);
  if (!score.exact() || utility <= view.utility) return;
  view.T_world_cam = steps.back().T_world_cam;
  view.score = score.score;
  view.utility = utility;
  view.polish = std::move(steps);
}

}  // namespace

bool polish(const PlannerContext& context, std::vector<RankedView>& ranked, const StopToken& stop) {
  if (context.polisher() == nullptr) return true;
  std::vector<RankedView> polished = ranked;
  const std::size_t count = std::min(polished.size(), context.polished_views());
  tbb::parallel_for(std::size_t(0), count,
                    [&](std::size_t i) { polish_one(context, polished[i], stop); });
  if (stop.stop_requested()) return false;
  std::sort(polished.begin(), polished.begin() + std::ptrdiff_t(count),
            [](const RankedView& a, const RankedView& b) {
              return a.utility != b.utility ? a.utility > b.utility : a.candidate < b.candidate;
            });
  ranked = std::move(polished);
  return true;
}

std::vector<ScoredStep> trace(const PlannerContext& context, const Plan& plan,
                              const ScoredCandidate& candidate, const StopToken& stop) {
  std::vector<ScoredStep> steps = context.trace(candidate.view, stop);
  for (const RankedView& view : plan.ranked) {
    if (&plan.candidates[view.candidate] != &candidate || view.polish.empty()) continue;
    steps.push_back(
        {{view.T_world_cam, ServoMove::polish}, {ScoreBound::Known::exact, view.score}});
  }
  return steps;
}

}  // namespace vantage::planner::detail
