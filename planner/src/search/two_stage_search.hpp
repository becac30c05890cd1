#pragma once

#include <span>

#include "vantage/planner/advanced/view_search.hpp"

namespace vantage::planner::detail {

/// Finds the best of many candidates by a method that is too expensive to run on all of them: a
/// cheaper one, without guarantees, picks a shortlist, and those are scored exactly.
///
/// In rounds, each about twice as large as the one before, so that there is an answer soon. What
/// was not on the shortlist is `pruned`; the best of the others are found for certain.
class ShortlistSearch {
 public:
  /// @param size of the shortlist; `cheap` finds at least as many for certain.
  ShortlistSearch(const ViewSearch& cheap, const ViewSearch& exact, int ranked, int size)
      : cheap_(cheap), exact_(exact), ranked_(ranked), size_(size) {}

  SearchResult run(std::span<const ViewCandidate> candidates, const StopToken& stop) const;

 private:
  ViewSearch cheap_, exact_;
  int ranked_, size_;
};

}  // namespace vantage::planner::detail
