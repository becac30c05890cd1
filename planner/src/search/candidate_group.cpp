#include "search/candidate_group.hpp"

#include <algorithm>
#include <numeric>

namespace vantage::planner::detail {

namespace {

/// Enough views to share rays among; few enough to look at all pairs of them, and to stop soon.
constexpr std::size_t kMaxAtSite = 32;

}  // namespace

std::vector<GroupRange> sites_of(std::span<const ViewCandidate> candidates) {
  std::vector<GroupRange> camera_groups;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const bool same =
        i > 0 && i - camera_groups.back().first < kMaxAtSite &&
        candidates[i].T_world_cam.translation() == candidates[i - 1].T_world_cam.translation();
    same ? void(camera_groups.back().last = i + 1) : camera_groups.push_back({i, i + 1});
  }
  return camera_groups;
}

std::vector<GroupRange> golden_ratio_order(const std::vector<GroupRange>& camera_groups) {
  const std::size_t n = camera_groups.size();
  std::size_t stride = std::max<std::size_t>(1, std::size_t(0.618 * double(n)));
  while (std::gcd(stride, n) != 1) ++stride;
  std::vector<GroupRange> order;
  for (std::size_t i = 0, at = 0; i < n; ++i, at = (at + stride) % n)
    order.push_back(camera_groups[at]);
  return order;
}

std::size_t finished(std::span<const ScoredCandidate> candidates) {
  return std::size_t(
      std::count_if(candidates.begin(), candidates.end(), [](const ScoredCandidate& candidate) {
        return candidate.rejected != InvalidReason::none ||
               candidate.score.known != ScoreBound::Known::nothing;
      }));
}

void CandidateGroup::prepare(const TopK& top, const StopToken& stop) {
  outcomes_.resize(range_.last - range_.first);
  std::optional<ExtremePoints> extremes;
  for (std::size_t c = 0; c < outcomes_.size() && !stop.stop_requested(); ++c) {
    const Pose& pose = candidates_[range_.first + c].T_world_cam;
    outcomes_[c].validity = context_->validity->examine(pose);
    outcomes_[c].ready = true;
    if (!outcomes_[c].validity.valid()) continue;
    const Score needed = top.needed(candidates_[range_.first + c].id);
    int iteration = 0;
    for (const ServoStep& step : context_->path(pose, extremes)) {
      const PinholeCamera view = context_->camera.moved_to(step.T_world_cam);
      const std::uint64_t share = context_->utility.share(view.centre());
      const auto bound = [&] {
        return context_->scorer->upper_bound_if_needed(view, Utility::needed(needed, share));
      };
      steps_.push_back({c, iteration++, view, share,
                        step.score ? ScoreBound{ScoreBound::Known::exact, *step.score}
                                   : ScoreBound{ScoreBound::Known::at_most, bound()}});
      bound_ = std::max(bound_, steps_.back().utility());
    }
  }
}

bool CandidateGroup::matters(const TopK& top) const {
  return std::any_of(steps_.begin(), steps_.end(), [&](const Step& step) {
    return step.utility() >= top.needed(candidates_[range_.first + step.candidate].id);
  });
}

void CandidateGroup::score(const TopK& top, const StopToken& stop) {
  // Views with one centre may share their rays; the group that promises most goes first, so that
  // the others have to beat it.
  const bool together = context_->scorer->shares_rays();
  std::vector<std::vector<Step*>> groups;
  for (Step& step : steps_) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& members) {
      return together && members.front()->view.centre() == step.view.centre();
    });
    group == groups.end() ? void(groups.push_back({&step})) : group->push_back(&step);
  }
  const auto promise = [](const std::vector<Step*>& group) {
    Score most = 0;
    for (const Step* step : group) most = std::max(most, step->utility());
    return most;
  };
  std::stable_sort(groups.begin(), groups.end(),
                   [&](const auto& a, const auto& b) { return promise(a) > promise(b); });
  for (const auto& group : groups) score_group(group, top, stop);
}

void CandidateGroup::score_group(std::span<Step* const> group, const TopK& top,
                                 const StopToken& stop) {
  std::vector<Step*> open;
  std::vector<PinholeCamera> views;
  std::vector<Score> needs;
  for (Step* step : group) {
    const Score need = needed(*step, top);
    if (step->score.exact() || step->score.score < need) continue;
    open.push_back(step), views.push_back(step->view), needs.push_back(need);
  }
  std::vector<ScoreBound> results(open.size());
  if (!open.empty()) context_->scorer->score(views, needs, results, stop);
  for (std::size_t i = 0; i < open.size(); ++i) open[i]->score = results[i];
}

/// The score with which a step would be its candidate's best, and that among the best of all.
Score CandidateGroup::needed(const Step& step, const TopK& top) const {
  Score utility = top.needed(candidates_[range_.first + step.candidate].id);
  if (const Step* best = best_exact(step.candidate)) {
    const Score to_beat = best->utility() + (best->iteration < step.iteration ? 1 : 0);
    utility = std::max(utility, to_beat);
  }
  return Utility::needed(utility, step.share);
}

/// The first of the best steps whose scores are exact.
const CandidateGroup::Step* CandidateGroup::best_exact(std::size_t candidate) const {
  const Step* best = nullptr;
  for (const Step& step : steps_) {
    if (step.candidate != candidate || !step.score.exact()) continue;
    if (best == nullptr || step.utility() > best->utility()) best = &step;
  }
  return best;
}

ScoredCandidate CandidateGroup::outcome(std::size_t candidate) const {
  const ViewValidity& validity = outcomes_[candidate].validity;
  ScoredCandidate result{candidates_[range_.first + candidate], validity.reason};
  result.check_says = validity.check_says;
  if (!validity.valid()) return result;
  const Step* best = best_exact(candidate);
  bool certain = best != nullptr, unknown = false;
  Score most = 0;
  for (const Step& step : steps_) {
    if (step.candidate != candidate) continue;
    unknown |= step.score.known == ScoreBound::Known::nothing;
    most = std::max(most, step.score.score);
    if (step.score.exact() || !certain) continue;
    certain = step.utility() < best->utility() ||
              (step.utility() == best->utility() && step.iteration > best->iteration);
  }
  if (unknown) return result;
  if (certain) {
    result.score = best->score;
    result.servo_iteration = best->iteration;
  } else {
    result.score = {ScoreBound::Known::at_most, most};
  }
  return result;
}

void CandidateGroup::report(std::span<ScoredCandidate> results, TopK& top) const {
  for (std::size_t c = 0; c < outcomes_.size(); ++c) {
    if (!outcomes_[c].ready) continue;
    const std::size_t index = range_.first + c;
    results[index] = outcome(c);
    if (!results[index].score.exact()) continue;
    const Step* best = best_exact(c);
    top.add(
        {candidates_[index].id,
         {index, best->view.T_world_cam(), best->iteration, best->score.score, best->utility()}});
  }
}

}  // namespace vantage::planner::detail
