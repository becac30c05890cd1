#include "vantage/planner/view_search.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "search/candidate_group.hpp"
#include "search/top_k.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

using detail::Ranking;
using detail::Site;
using detail::SiteRange;

// The first chunk is small, so that there is an answer soon; later ones are large, so that the best
// of many go first. Batches are fixed: what is asked of a site must not depend on the threads.
constexpr std::size_t kFirstChunkViews = 64;
constexpr std::size_t kLargestChunkViews = 8192;
constexpr std::size_t kBatchSites = 16;

}  // namespace

void SearchOptions::check() const {
  if (ranked < 1) {
    throw bad_input("ranked", fmt::format("found {}; expected the number of best views to find for "
                                          "certain, at least 1",
                                          ranked));
  }
  if (travel) travel->check();
}

struct ViewSearch::Impl {
  detail::SearchTools tools;
  SearchOptions options;

  /// Scores the sites of one chunk, best promise first.
  void search(std::vector<Site>& sites, SearchResult& result, Ranking& ranking,
              const StopToken& stop) const {
    tbb::parallel_for(std::size_t(0), sites.size(),
                      [&](std::size_t i) { sites[i].prepare(ranking, stop); });
    std::vector<Site*> order;
    for (Site& site : sites) order.push_back(&site);
    std::sort(order.begin(), order.end(), [](const Site* a, const Site* b) {
      return a->bound() != b->bound() ? a->bound() > b->bound() : a->first() < b->first();
    });
    for (std::size_t next = 0; next < order.size() && !stop.stop_requested();) {
      std::vector<Site*> batch;
      for (; next < order.size() && batch.size() < kBatchSites; ++next) {
        if (order[next]->matters(ranking)) {
          batch.push_back(order[next]);
        } else {
          finish(*order[next], result, ranking, stop);
        }
      }
      tbb::parallel_for(std::size_t(0), batch.size(),
                        [&](std::size_t i) { batch[i]->score(ranking, stop); });
      for (const Site* site : batch) finish(*site, result, ranking, stop);
    }
  }

  static void finish(const Site& site, SearchResult& result, Ranking& ranking,
                     const StopToken& stop) {
    site.report(result.candidates, ranking);
    stop.advance(site.size());
  }
};

ViewSearch::ViewSearch(std::shared_ptr<const ViewScorer> scorer,
                       std::shared_ptr<const ViewChecker> checker,
                       std::shared_ptr<const ServoRefiner> servo, const PinholeCamera& camera,
                       const SearchOptions& options) {
  options.check();
  impl_ =
      std::make_shared<const Impl>(Impl{{std::move(scorer), std::move(checker), std::move(servo),
                                         camera, detail::Utility(options.travel)},
                                        options});
}

SearchResult ViewSearch::run(std::span<const ViewCandidate> candidates,
                             const StopToken& stop) const {
  SearchResult result;
  for (const ViewCandidate& view : candidates) result.candidates.push_back({view});
  stop.expect(candidates.size());
  const std::vector<SiteRange> order = detail::strewn(detail::sites_of(candidates));
  Ranking ranking(impl_->options.ranked);
  std::size_t chunk_views = kFirstChunkViews;
  for (std::size_t next = 0; next < order.size() && !stop.stop_requested();) {
    std::vector<Site> sites;
    for (std::size_t views = 0; next < order.size() && views < chunk_views; ++next) {
      sites.emplace_back(impl_->tools, candidates, order[next]);
      views += sites.back().size();
    }
    impl_->search(sites, result, ranking, stop);
    chunk_views = std::min(2 * chunk_views, kLargestChunkViews);
  }
  result.ranked = ranking.views();
  result.finished = detail::finished(result.candidates);
  if (result.finished < candidates.size()) result.stopped = stop.reason();
  return result;
}

std::vector<ScoredStep> ViewSearch::trace(const ViewCandidate& candidate,
                                          const StopToken& stop) const {
  std::optional<OutermostShadow> none;
  const std::vector<ServoStep> path = impl_->tools.path(candidate.T_world_cam, none);
  std::vector<ScoredStep> steps(path.size());
  tbb::parallel_for(std::size_t(0), path.size(), [&](std::size_t i) {
    const PinholeCamera view = impl_->tools.camera.moved_to(path[i].T_world_cam);
    steps[i] = {path[i], impl_->tools.scorer->score(view, stop)};
  });
  return steps;
}

}  // namespace vantage
