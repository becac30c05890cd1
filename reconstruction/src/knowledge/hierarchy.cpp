#include "knowledge/hierarchy.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

const std::vector<std::string>& parents_of(const Parents& parents, std::string_view name) {
  static const std::vector<std::string> kNone;
  const auto found = parents.find(name);
  return found == parents.end() ? kNone : found->second;
}

/// The names that are left when every name without parents is taken away, and again: those of
/// circles, and of what is below them. In linear time and without recursion, whatever a file says.
std::set<std::string_view> in_or_below_circles(const Parents& parents) {
  std::map<std::string_view, std::size_t> open_parents;
  std::map<std::string_view, std::vector<std::string_view>> children;
  for (const auto& [name, its_parents] : parents) {
    open_parents[name] += its_parents.size();
    for (const std::string& parent : its_parents) {
      open_parents.try_emplace(parent, 0);
      children[parent].push_back(name);
    }
  }
  std::set<std::string_view> left;
  std::vector<std::string_view> free;
  for (const auto& [name, count] : open_parents) {
    left.insert(name);
    if (count == 0) free.push_back(name);
  }
  while (!free.empty()) {
    const std::string_view name = free.back();
    free.pop_back();
    left.erase(name);
    for (const std::string_view child : children[name]) {
      if (--open_parents[child] == 0) free.push_back(child);
    }
  }
  return left;
}

/// A way up from a name back to itself, both ends included.
std::vector<std::string_view> way_around(const Parents& parents,
                                         const std::set<std::string_view>& left) {
  std::vector<std::string_view> way{*left.begin()};
  while (true) {  // each that is left has a parent that is, too
    const auto& its_parents = parents_of(parents, way.back());
    const std::string_view up = *std::find_if(its_parents.begin(), its_parents.end(),
                                              [&](const auto& p) { return left.contains(p); });
    const auto first = std::size_t(std::find(way.begin(), way.end(), up) - way.begin());
    way.push_back(up);
    if (first + 1 < way.size()) return {way.begin() + std::ptrdiff_t(first), way.end()};
  }
}

}  // namespace

void add_parents(Parents& parents, const std::string& name, const std::vector<std::string>& more) {
  std::vector<std::string>& all = parents[name];
  for (const std::string& parent : more) {
    if (std::find(all.begin(), all.end(), parent) == all.end()) all.push_back(parent);
  }
}

bool has_ancestor(const Parents& parents, std::string_view name, std::string_view ancestor) {
  std::set<std::string_view> seen{name};
  std::vector<std::string_view> open{name};
  while (!open.empty()) {
    const std::string_view at = open.back();
    open.pop_back();
    if (at == ancestor) return true;
    for (const std::string& parent : parents_of(parents, at)) {
      if (seen.insert(parent).second) open.push_back(parent);
    }
  }
  return false;
}

void check_no_circle(const Parents& parents, const std::map<std::string, std::string>& places) {
  const std::set<std::string_view> left = in_or_below_circles(parents);
  if (left.empty()) return;
  const std::vector<std::string_view> way = way_around(parents, left);
  const std::string name(way.front());
  const auto place = places.find(name);
  throw bad_input(
      place == places.end() ? name : place->second,
      fmt::format(
          "found the cycle \"{}\": a type cannot be its own ancestor; remove one of these steps",
          fmt::join(way, " is a ")));
}

}  // namespace vantage::reconstruction::detail
