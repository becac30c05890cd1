#include "workcell/marker_dictionaries.hpp"

#include <map>
#include <utility>

namespace vantage {
namespace {

/// 250 for 4X4_250; families without sizes have one dictionary.
int size_of(const std::string& dictionary) {
  const std::string family = marker_family(dictionary);
  return family == dictionary ? 0 : std::stoi(dictionary.substr(family.size() + 1));
}

}  // namespace

std::vector<std::string> dictionaries_of(const Workcell& workcell) {
  std::map<std::string, std::pair<int, std::string>> by_family;
  const auto add = [&](const Marker& marker) {
    auto& largest = by_family[marker_family(marker.dictionary)];
    largest = std::max(largest, {size_of(marker.dictionary), marker.dictionary});
  };
  for (const TypePtr& type : workcell.knowledge->types()) {
    for (const Marker& marker : type->markers()) add(marker);
  }
  if (workcell.board) {
    for (const Marker& marker : workcell.board->markers) add(marker);
  }
  std::vector<std::string> names;
  for (const auto& [family, largest] : by_family) names.push_back(largest.second);
  return names;
}

}  // namespace vantage
