#include "vantage/planner/advanced/view_search.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "search/candidate_group.hpp"
#include "search/top_k.hpp"

namespace vantage {
namespace {

using planner::detail::CandidateGroup;
using planner::detail::GroupRange;
using planner::detail::TopK;

// The first chunk is small, so that there is an answer soon; later ones are large, so that the best
// of many go first. Batches are fixed: what is asked of a group must not depend on the threads.
constexpr std::size_t kFirstChunkViews = 64;
constexpr std::size_t kLargestChunkViews = 8192;
constexpr std::size_t kBatchSites = 16;

}  // namespace

struct ViewSearch::Impl {
  planner::detail::SearchTools context;
  SearchOptions options;

  /// Scores the groups of one chunk, best promise first.
  void search(std::vector<CandidateGroup>& camera_groups, SearchResult& result, TopK& top,
              const StopToken& stop) const {
    tbb::parallel_for(std::size_t(0), camera_groups.size(),
                      [&](std::size_t i) { camera_groups[i].prepare(top, stop); });
    std::vector<CandidateGroup*> order;
    for (CandidateGroup& group : camera_groups) order.push_back(&group);
    std::sort(order.begin(), order.end(), [](const CandidateGroup* a, const CandidateGroup* b) {
      return a->bound() != b->bound() ? a->bound() > b->bound() : a->first() < b->first();
    });
    for (std::size_t next = 0; next < order.size() && !stop.stop_requested();) {
      std::vector<CandidateGroup*> batch;
      for (; next < order.size() && batch.size() < kBatchSites; ++next) {
        if (order[next]->matters(top)) {
          batch.push_back(order[next]);
        } else {
          finish(*order[next], result, top, stop);
        }
      }
      tbb::parallel_for(std::size_t(0), batch.size(),
                        [&](std::size_t i) { batch[i]->score(top, stop); });
      for (const CandidateGroup* group : batch) finish(*group, result, top, stop);
    }
  }

  static void finish(const CandidateGroup& group, SearchResult& result, TopK& top,
                     const StopToken& stop) {
    group.report(result.candidates, top);
    stop.advance(group.size());
  }
};

ViewSearch::ViewSearch(std::shared_ptr<const ViewScorer> scorer,
                       std::shared_ptr<const ViewValidityChecker> validity,
                       std::shared_ptr<const ServoRefiner> servo, const PinholeCamera& camera,
                       const SearchOptions& options) {
  options.check();
  impl_ =
      std::make_shared<const Impl>(Impl{{std::move(scorer), std::move(validity), std::move(servo),
                                         camera, planner::detail::Utility(options.travel)},
                                        options});
}

SearchResult ViewSearch::run(std::span<const ViewCandidate> candidates,
                             const StopToken& stop) const {
  SearchResult result;
  for (const ViewCandidate& view : candidates) result.candidates.push_back({view});
  stop.expect(candidates.size());
  const std::vector<GroupRange> order =
      planner::detail::golden_ratio_order(planner::detail::sites_of(candidates));
  TopK top(impl_->options.ranked);
  std::size_t chunk_views = kFirstChunkViews;
  for (std::size_t next = 0; next < order.size() && !stop.stop_requested();) {
    std::vector<CandidateGroup> camera_groups;
    for (std::size_t views = 0; next < order.size() && views < chunk_views; ++next) {
      camera_groups.emplace_back(impl_->context, candidates, order[next]);
      views += camera_groups.back().size();
    }
    impl_->search(camera_groups, result, top, stop);
    chunk_views = std::min(2 * chunk_views, kLargestChunkViews);
  }
  result.ranked = top.views();
  result.finished = planner::detail::finished(result.candidates);
  if (result.finished < candidates.size()) result.stopped = stop.reason();
  return result;
}

std::vector<ScoredStep> ViewSearch::trace(const ViewCandidate& candidate,
                                          const StopToken& stop) const {
  std::optional<ExtremePoints> none;
  const std::vector<ServoStep> path = impl_->context.path(candidate.T_world_cam, none);
  std::vector<ScoredStep> steps(path.size());
  tbb::parallel_for(std::size_t(0), path.size(), [&](std::size_t i) {
    const PinholeCamera view = impl_->context.camera.moved_to(path[i].T_world_cam);
    steps[i] = {path[i], impl_->context.scorer->score(view, stop)};
  });
  return steps;
}

}  // namespace vantage
