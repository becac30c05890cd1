#include "search/two_stage_search.hpp"

#include <algorithm>
#include <set>

#include "search/candidate_group.hpp"
#include "search/top_k.hpp"

namespace vantage::planner::detail {
namespace {

constexpr std::size_t kFirstRoundViews = 512;

/// Some of the candidates, and where they stand in the list of all.
struct Part {
  std::vector<std::size_t> indices;
  std::vector<ViewCandidate> views;

  void add(std::size_t index, std::span<const ViewCandidate> candidates) {
    indices.push_back(index);
    views.push_back(candidates[index]);
  }
  TopK::Entry entry(RankedView view) const {
    const int id = views[view.candidate].id;
    view.candidate = indices[view.candidate];
    return {id, view};
  }
};

/// Takes groups until there are enough views.
Part next_round(const std::vector<GroupRange>& camera_groups, std::size_t& next,
                std::size_t max_views, std::span<const ViewCandidate> candidates) {
  Part round;
  for (; next < camera_groups.size() && round.views.size() < max_views; ++next) {
    for (std::size_t c = camera_groups[next].first; c < camera_groups[next].last; ++c)
      round.add(c, candidates);
  }
  return round;
}

void report_cheap(const SearchResult& cheap, const Part& round, SearchResult& result) {
  for (std::size_t i = 0; i < round.indices.size(); ++i) {
    ScoredCandidate& candidate = result.candidates[round.indices[i]];
    candidate.rejected = cheap.candidates[i].rejected;
    candidate.check_says = cheap.candidates[i].check_says;
    if (cheap.candidates[i].score.known != ScoreBound::Known::nothing) {
      candidate.score.known = ScoreBound::Known::pruned;
    }
  }
}

}  // namespace

SearchResult ShortlistSearch::run(std::span<const ViewCandidate> candidates,
                                  const StopToken& stop) const {
  SearchResult result;
  for (const ViewCandidate& view : candidates) result.candidates.push_back({view});
  const std::vector<GroupRange> camera_groups = golden_ratio_order(sites_of(candidates));
  TopK shortlist(size_), best(ranked_);
  std::set<std::size_t> scored;
  std::size_t round_views = kFirstRoundViews;
  for (std::size_t next = 0; next < camera_groups.size() && !stop.stop_requested();
       round_views *= 2) {
    const Part round = next_round(camera_groups, next, round_views, candidates);
    const SearchResult cheap = cheap_.run(round.views, stop);
    report_cheap(cheap, round, result);
    for (const RankedView& view : cheap.ranked) shortlist.add(round.entry(view));

    Part chosen;
    for (const RankedView& view : shortlist.views()) {
      if (scored.insert(view.candidate).second) chosen.add(view.candidate, candidates);
    }
    const SearchResult exact = exact_.run(chosen.views, stop);
    for (std::size_t i = 0; i < chosen.indices.size(); ++i) {
      result.candidates[chosen.indices[i]] = exact.candidates[i];
    }
    for (const RankedView& view : exact.ranked) best.add(chosen.entry(view));
  }
  result.ranked = best.views();
  result.finished = finished(result.candidates);
  if (result.finished < candidates.size()) result.stopped = stop.reason();
  return result;
}

}  // namespace vantage::planner::detail
