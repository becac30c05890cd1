#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "plan/polish_ranked.hpp"
#include "vantage/planner/plan.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/volume/advanced/shadow_regions.hpp"

namespace vantage {
namespace {

const ScoredCandidate& candidate_of(const Plan& plan, int id) {
  const auto found =
      std::find_if(plan.candidates.begin(), plan.candidates.end(),
                   [&](const ScoredCandidate& candidate) { return candidate.view.id == id; });
  if (found != plan.candidates.end()) return *found;
  throw bad_input("explain", fmt::format("found candidate {}; expected 0 to {}", id,
                                         plan.candidates.size() - 1));
}

std::string score_text(const Plan& plan, Score score) {
  return fmt::format("{:.6g} {}", plan.in_units(score), plan.score_unit_name);
}

constexpr const char* kPolished = " (polished)";

std::string polish_text(const ScoredStep& step) {
  return step.step.move == ServoMove::polish ? kPolished : "";
}

std::string verdict_of(const Plan& plan, const ViewExplanation& view,
                       const planner::detail::Utility& utility) {
  if (view.rejected != InvalidReason::none) {
    return fmt::format("rejected: {}", view.rejection());
  }
  const ScoredStep& best_step = view.trace[view.best_step];
  const Score own = best_step.score.score;
  const RankedView* best = plan.best();
  if (best == nullptr) return "no view reveals any shadow, and neither does this one";
  const int best_id = plan.candidates[best->candidate].view.id;
  if (best_id == view.candidate.id) {
    return fmt::format("the best of {} candidates: {}{}", plan.candidates.size(),
                       score_text(plan, own), polish_text(best_step));
  }
  std::string text = fmt::format("lost: {}{}, and candidate {} has {}{}", score_text(plan, own),
                                 polish_text(best_step), best_id, score_text(plan, best->score),
                                 best->polish.empty() ? "" : kPolished);
  const Score left = utility.of(own, utility.share(best_step.step.T_world_cam.translation()));
  if (plan.request.search.travel) {
    text += fmt::format("; after travel cost {} against {}", score_text(plan, left),
                        score_text(plan, best->utility));
  }
  if (left == best->utility) text += "; ties go to the lower id";
  if (plan.stopped != StopReason::none && left > best->utility) {
    text += "; it was not reached before the plan was stopped";
  }
  return text;
}

/// Explains candidates of one plan.
class Explainer {
 public:
  Explainer(const Plan& plan, const planner::detail::PlannerContext& context)
      : plan_(plan),
        context_(context),
        utility_(plan.request.search.travel),
        regions_(*plan.classified),
        centres_(plan.classified->centres(VoxelState::shadow)) {}

  ViewExplanation explain(const ScoredCandidate& candidate) const {
    ViewExplanation view{.candidate = candidate.view};
    ViewValidity validity = context_.search_tools().validity->examine(candidate.view.T_world_cam);
    view.rejected = validity.reason;
    view.check_says = std::move(validity.check_says);
    if (view.rejected == InvalidReason::none) score(candidate, view);
    view.verdict = verdict_of(plan_, view, utility_);
    return view;
  }

 private:
  void score(const ScoredCandidate& candidate, ViewExplanation& view) const {
    view.trace = planner::detail::trace(context_, plan_, candidate);
    const auto worth = [&](const ScoredStep& step) {
      return utility_.of(step.score.score, utility_.share(step.step.T_world_cam.translation()));
    };
    const auto best = std::max_element(
        view.trace.begin(), view.trace.end(),
        [&](const ScoredStep& a, const ScoredStep& b) { return worth(a) < worth(b); });
    view.best_step = std::size_t(best - view.trace.begin());
    const PinholeCamera camera = context_.camera().moved_to(best->step.T_world_cam);
    view.terms = context_.scorer()->terms(camera);
    const std::vector<std::uint8_t> seen = context_.voxels().revealed(camera);
    view.revealed_voxels = std::uint64_t(std::count(seen.begin(), seen.end(), std::uint8_t(1)));
    view.regions = region_gains(seen);
  }

  /// How much of each region of the shadow is among the voxels that are seen.
  std::vector<RegionGain> region_gains(const std::vector<std::uint8_t>& seen) const {
    std::map<std::size_t, std::uint64_t> revealed;
    for (std::size_t i = 0; i < centres_.size(); ++i) {
      if (seen[i] == 0) continue;
      const auto voxel = plan_.classified->geometry().voxel_at(centres_[i].cast<double>());
      ++revealed[std::size_t(regions_.label(voxel.value()) - 1)];
    }
    std::vector<RegionGain> gains;
    for (const auto& [region, voxels] : revealed) {
      gains.push_back({region, regions_.list()[region].voxels, voxels});
    }
    std::stable_sort(gains.begin(), gains.end(), [](const RegionGain& a, const RegionGain& b) {
      return a.revealed > b.revealed;
    });
    return gains;
  }

  const Plan& plan_;
  const planner::detail::PlannerContext& context_;
  planner::detail::Utility utility_;
  ShadowRegions regions_;
  Points centres_;
};

/// The plan's own, or one like it.
std::shared_ptr<const planner::detail::PlannerContext> context_of(const WorldModel& world,
                                                                  const Plan& plan) {
  if (plan.context != nullptr) return plan.context;
  return std::make_shared<const planner::detail::PlannerContext>(
      world, plan.classified, plan.request, plan.candidates.size());
}

}  // namespace

std::vector<ViewExplanation> explain_views(const WorldModel& world, const Plan& plan,
                                           std::span<const int> ids, const StopToken& stop) {
  if (plan.classified == nullptr) {
    throw bad_input("explain", "the plan was stopped before the work area was classified");
  }
  std::vector<const ScoredCandidate*> candidates;
  for (const int id : ids) candidates.push_back(&candidate_of(plan, id));
  std::vector<ViewExplanation> explained;
  if (candidates.empty() || stop.stop_requested()) return explained;
  const auto context = context_of(world, plan);
  const Explainer explainer(plan, *context);
  for (const ScoredCandidate* candidate : candidates) {
    if (stop.stop_requested()) break;
    explained.push_back(explainer.explain(*candidate));
  }
  return explained;
}

ViewExplanation explain_view(const WorldModel& world, const Plan& plan, int id) {
  return explain_views(world, plan, {&id, 1}).front();
}

std::uint64_t revealed_voxels(const WorldModel& world, const Plan& plan, const Pose& T_world_cam) {
  const auto context = context_of(world, plan);
  return context->voxels().score(context->camera().moved_to(T_world_cam)).score;
}

}  // namespace vantage
