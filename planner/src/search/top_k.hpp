#pragma once

#include <algorithm>
#include <vector>

#include "vantage/planner/advanced/view_search.hpp"

namespace vantage::planner::detail {

/// The best candidates so far, best first; among equals the one with the lower id. A view that
/// reveals nothing is none.
class TopK {
 public:
  explicit TopK(int most) : max_(std::size_t(most)) {}

  struct Entry {
    int id = 0;
    RankedView view;
  };

  /// The least utility with which a candidate would be among the best.
  Score needed(int id) const {
    if (entries_.size() < max_) return 1;
    const Entry& last = entries_.back();
    return id < last.id ? last.view.utility : last.view.utility + 1;
  }

  void add(const Entry& entry) {
    if (entry.view.utility < needed(entry.id)) return;
    const auto place =
        std::upper_bound(entries_.begin(), entries_.end(), entry, [](const auto& a, const auto& b) {
          if (a.view.utility != b.view.utility) return a.view.utility > b.view.utility;
          return a.id < b.id;
        });
    entries_.insert(place, entry);
    if (entries_.size() > max_) entries_.pop_back();
  }

  std::vector<RankedView> views() const {
    std::vector<RankedView> views;
    for (const Entry& entry : entries_) views.push_back(entry.view);
    return views;
  }

 private:
  std::size_t max_;
  std::vector<Entry> entries_;
};

}  // namespace vantage::planner::detail
