#include "vantage/planner/plan.hpp"

#include <tbb/parallel_for.h>

#include <chrono>
#include <map>

#include "plan/planner_context.hpp"
#include "plan/polish_ranked.hpp"
#include "plan/view_sequence.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "vantage/volume/advanced/shadow_filter.hpp"

namespace vantage {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Errors in a request are reported before any work is done.
void check(const PlanRequest& request) {
  (void)PinholeCamera(request.intrinsics, Pose(), request.range, "movable camera");
  request.constraints.check();
  request.servo.check();
  request.polish.check();
  request.search.check();
  request.views.check();
  check(request.method);
  request.gain.check();
  request.volume.check();
}

void search(const WorldModel& world, const std::vector<ViewCandidate>& views, Plan& plan,
            const StopToken& stop) {
  // Of fine grids, the shadow's surface and its points take a while each.
  const auto stopped = [&] { return (plan.stopped = stop.reason()) != StopReason::none; };
  if (stopped()) return;
  const PlanningScene scene(world, plan.classified, plan.request.volume.occluders);
  if (stopped()) return;
  plan.context = std::make_shared<const planner::detail::PlannerContext>(world, scene, plan.request,
                                                                         views.size());
  const planner::detail::PlannerContext& context = *plan.context;
  plan.score_unit = context.scorer()->unit();
  plan.score_unit_name = context.scorer()->unit_name();
  SearchResult found = context.search(views, stop);
  plan.candidates = std::move(found.candidates);
  plan.ranked = std::move(found.ranked);
  plan.finished = found.finished;
  plan.stopped = found.stopped;
  if (plan.ranked.empty()) return;
  if (plan.stopped == StopReason::none && !planner::detail::polish(context, plan.ranked, stop)) {
    plan.stopped = stop.reason();
  }
  tbb::parallel_for(std::size_t(0), plan.ranked.size(), [&](std::size_t i) {
    RankedView& view = plan.ranked[i];
    const PinholeCamera camera = context.camera().moved_to(view.T_world_cam);
    view.revealed_voxels =
        context.by_voxels() ? view.score : context.voxels().ViewScorer::score(camera).score;
    view.gain = context.gain().estimate(camera);
  });
  plan.trace =
      planner::detail::trace(context, plan, plan.candidates[plan.ranked.front().candidate], stop);
  planner::detail::add_view(context.voxels(), context.camera(), plan.ranked.front(), plan);
  if (plan.request.views.most > 1) planner::detail::add_next_views(world, context, plan, stop);
}

Plan plan_of(const PlanRequest& request, const std::vector<ViewCandidate>& views) {
  Plan plan{.request = request};
  for (const ViewCandidate& view : views) plan.candidates.push_back({view});
  return plan;
}

void search_classified(const WorldModel& world, const std::vector<ViewCandidate>& views, Plan& plan,
                       const StopToken& stop) {
  const auto start = std::chrono::steady_clock::now();
  plan.classified = without_false_shadow(plan.classified, world, plan.request.volume);
  plan.grid = plan.classified;
  search(world, views, plan, stop);
  plan.score_s = seconds_since(start);
}

}  // namespace

std::vector<std::pair<std::string, std::size_t>> rejections_of(const Plan& plan) {
  std::map<std::pair<InvalidReason, std::string_view>, std::size_t> counts;
  for (const ScoredCandidate& candidate : plan.candidates) {
    if (candidate.rejected == InvalidReason::none) continue;
    ++counts[{candidate.rejected, candidate.rejection()}];
  }
  std::vector<std::pair<std::string, std::size_t>> rejections;
  for (const auto& [reason, count] : counts) rejections.emplace_back(reason.second, count);
  return rejections;
}

Plan plan_next_view(const WorldModel& world, const PlanRequest& request, const StopToken& stop) {
  check(request);
  const GridGeometry geometry = GridGeometry::covering(request.work_area, request.voxel_size_m);
  const std::vector<ViewCandidate> views = view_candidates(request.candidates, request.work_area);
  Plan plan = plan_of(request, views);
  const auto start = std::chrono::steady_clock::now();
  plan.classified = classify(world, geometry, request.volume, stop);
  plan.classify_s = seconds_since(start);
  if (plan.classified == nullptr) {
    plan.stopped = stop.reason();
  } else {
    search_classified(world, views, plan, stop);
  }
  return plan;
}

Plan plan_next_view(const WorldModel& world, std::shared_ptr<const StateGrid> classified,
                    const PlanRequest& request, const StopToken& stop) {
  check(request);
  const std::vector<ViewCandidate> views = view_candidates(request.candidates, request.work_area);
  Plan plan = plan_of(request, views);
  plan.classified = std::move(classified);
  search_classified(world, views, plan, stop);
  return plan;
}

}  // namespace vantage
