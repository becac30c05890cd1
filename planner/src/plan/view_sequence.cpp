#include "plan/view_sequence.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "plan/polish_ranked.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage::planner::detail {
namespace {

constexpr std::size_t kBatch = 16;

/// The candidate with the most to reveal of what is left. What it gained once bounds what it gains
/// now, since shadow only shrinks: most candidates are never looked at again.
class LazyGreedy {
 public:
  LazyGreedy(const SearchTools& context, const std::vector<ScoredCandidate>& candidates)
      : context_(context), candidates_(candidates) {
    for (const ScoredCandidate& candidate : candidates) views_.push_back(candidate.view);
  }

  /// @param scorer of the shadow that is left, and @param travel from the last view.
  /// @returns nothing if there is no view left that reveals something, or if stopped.
  std::optional<RankedView> next(std::shared_ptr<const ViewScorer> scorer,
                                 const std::optional<TravelCost>& travel, const StopToken& stop) {
    SearchTools context = context_;
    context.scorer = std::move(scorer);
    context.utility = Utility(travel);
    TopK top(1);
    const std::vector<std::size_t> order = by_bound();
    for (std::size_t next = 0; next < order.size();) {
      std::vector<CandidateGroup> batch;
      for (; next < order.size() && batch.size() < kBatch; ++next) {
        const std::size_t c = order[next];
        if (candidates_[c].score.score < top.needed(views_[c].id)) continue;
        batch.emplace_back(context, views_, GroupRange{c, c + 1});
      }
      tbb::parallel_for(std::size_t(0), batch.size(), [&](std::size_t i) {
        batch[i].prepare(top, stop);
        batch[i].score(top, stop);
      });
      if (stop.stop_requested()) return std::nullopt;
      for (const CandidateGroup& group : batch) group.report(candidates_, top);
    }
    const std::vector<RankedView> best = top.views();
    return best.empty() ? std::nullopt : std::optional(best.front());
  }

 private:
  std::vector<std::size_t> by_bound() const {
    std::vector<std::size_t> order(candidates_.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return candidates_[a].score.score > candidates_[b].score.score;
    });
    return order;
  }

  SearchTools context_;
  std::vector<ScoredCandidate> candidates_;
  std::vector<ViewCandidate> views_;
};

std::optional<RankedView> best_anew(const PlannerContext& left,
                                    const std::vector<ScoredCandidate>& candidates,
                                    const StopToken& stop) {
  std::vector<ViewCandidate> views;
  for (const ScoredCandidate& candidate : candidates) views.push_back(candidate.view);
  const SearchResult result = left.search(views, stop);
  if (result.stopped != StopReason::none || result.ranked.empty()) return std::nullopt;
  return result.ranked.front();
}

/// A view that was chosen, as a camera; for the mesh method with the depths that it will measure if
/// nothing stands in the shadow.
DepthCamera taken(const PinholeCamera& view, const WorldModel& world, const Plan& plan) {
  if (!std::holds_alternative<MeshMethod>(plan.request.method)) return {"view", view, nullptr};
  const DepthRange range{1e-3 * view.range().near_m, view.range().far_m};
  const auto occluders = occluder_scene(world, *plan.classified, plan.request.volume.occluders);
  const DepthImage hits =
      occluders->render_depth({view.intrinsics(), view.T_world_cam(), range, "view"});
  std::vector<float> depths_m(hits.metres().begin(), hits.metres().end());
  for (float& depth : depths_m) {
    if (std::isnan(depth)) depth = float(range.far_m);  // nothing in the way
  }
  const Intrinsics& k = view.intrinsics();
  return {"view", view, std::make_shared<const DepthImage>(k.width, k.height, depths_m)};
}

/// The request for the views after one at `T_world_cam`.
PlanRequest from_view(PlanRequest request, const Pose& T_world_cam) {
  if (request.search.travel) request.search.travel->from_m = T_world_cam.translation();
  return request;
}

/// By what a plan's views are chosen by.
bool worth_it(const Plan& plan, std::uint64_t revealed_voxels, const GainEstimate& gain) {
  const ViewSequenceOptions& views = plan.request.views;
  const bool expected = plan.request.value == ViewValue::expected;
  const double gain_m3 = expected ? gain.expected_m3 : plan.volume_m3(revealed_voxels);
  return revealed_voxels > 0 && gain_m3 >= views.min_gain_m3 &&
         gain_m3 >= views.min_gain_share * plan.classified->volume_m3(VoxelState::shadow);
}

}  // namespace

void add_view(const VoxelScorer& left, const PinholeCamera& camera, const RankedView& view,
              Plan& plan) {
  const std::vector<std::uint8_t> seen = left.revealed(camera.moved_to(view.T_world_cam));
  plan.views.push_back(
      {view, std::uint64_t(std::count(seen.begin(), seen.end(), std::uint8_t(1)))});
  plan.grid = plan.grid->with_revealed(seen);
}

void add_next_views(const WorldModel& world, const PlannerContext& context, Plan& plan,
                    const StopToken& stop) {
  const bool lazy = context.by_voxels();
  LazyGreedy greedy(context.search_tools(), plan.candidates);
  WorldModel seen = world;
  while (int(plan.views.size()) < plan.request.views.most && !stop.stop_requested()) {
    const Pose& last = plan.views.back().view.T_world_cam;
    // A method that cannot bound one gain by another searches again, with the views before taken.
    seen.cameras.push_back(taken(context.camera().moved_to(last), world, plan));
    const PlanRequest request = from_view(plan.request, last);
    const PlannerContext left(seen, plan.grid, request, plan.candidates.size());
    const std::optional<RankedView> next =
        lazy ? greedy.next(left.scorer(), request.search.travel, stop)
             : best_anew(left, plan.candidates, stop);
    if (!next) break;
    std::vector<RankedView> best{*next};
    if (!polish(left, best, stop)) break;
    const PinholeCamera view = context.camera().moved_to(best.front().T_world_cam);
    const GainEstimate gain = left.gain().estimate(view);
    if (!worth_it(plan, left.voxels().score(view).score, gain)) return;
    best.front().gain = gain;
    add_view(left.voxels(), context.camera(), best.front(), plan);
  }
  if (int(plan.views.size()) < plan.request.views.most && plan.stopped == StopReason::none) {
    plan.stopped = stop.reason();
  }
}

}  // namespace vantage::planner::detail
