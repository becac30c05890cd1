#include <algorithm>
#include <map>
#include <set>

#include "voting/votes.hpp"

namespace vantage::detail {
namespace {

constexpr std::size_t kNeighbours = 4;

using Readings = std::vector<const Reading*>;

double distance_px(const Reading& a, const Reading& b) {
  return (a.sighting->points()->pixels.front() - b.sighting->points()->pixels.front()).norm();
}

/// Readings that may be of one object with this one, those that are nearest to it in the image.
Readings neighbours(const Reading& reading, const Readings& all) {
  std::vector<std::pair<double, const Reading*>> near;
  for (const Reading* other : all) {
    if (go_together(reading, *other)) near.emplace_back(distance_px(reading, *other), other);
  }
  const auto count = std::ptrdiff_t(std::min(near.size(), kNeighbours));
  std::partial_sort(
      near.begin(), near.begin() + count, near.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first < b.first : a.second < b.second;  // of one array
      });
  Readings nearest;
  for (std::ptrdiff_t i = 0; i < count; ++i) nearest.push_back(near[std::size_t(i)].second);
  return nearest;
}

void add_groups_around(const Reading& reading, const Readings& all,
                       std::set<ReadingGroup>& groups) {
  const Readings near = neighbours(reading, all);
  for (std::size_t i = 0; i < near.size(); ++i) {
    for (std::size_t j = i + 1; j < near.size(); ++j) {
      if (!go_together(*near[i], *near[j])) continue;
      ReadingGroup group{&reading, near[i], near[j]};
      std::sort(group.begin(), group.end());
      groups.insert(group);
    }
  }
}

}  // namespace

std::vector<ReadingGroup> group_points(const Ballot& ballot) {
  std::map<std::pair<std::size_t, std::string>, Readings> single;  // by view and type
  for (const Reading& reading : ballot.readings) {
    if (has_pose(reading)) continue;
    single[{reading.sighting->id.view, reading.type().name}].push_back(&reading);
  }
  std::vector<ReadingGroup> result;
  for (const auto& [place, readings] : single) {
    std::set<ReadingGroup> groups;
    for (const Reading* reading : readings) add_groups_around(*reading, readings, groups);
    result.insert(result.end(), groups.begin(), groups.end());
  }
  return result;
}

}  // namespace vantage::detail
