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

/// The largest dictionary of each family, with its size.
using Families = std::map<std::string, std::pair<int, std::string>>;

void add_dictionary(const std::string& dictionary, Families& families) {
  auto& largest = families[marker_family(dictionary)];
  largest = std::max(largest, {size_of(dictionary), dictionary});
}

std::vector<std::string> largest_of(const Families& families) {
  std::vector<std::string> names;
  for (const auto& [family, largest] : families) names.push_back(largest.second);
  return names;
}

}  // namespace

std::vector<std::string> dictionaries_of(const Workcell& workcell) {
  Families by_family;
  for (const TypePtr& type : workcell.knowledge->types()) {
    for (const Marker& marker : type->markers()) add_dictionary(marker.dictionary, by_family);
  }
  if (workcell.board) {
    for (const Marker& marker : workcell.board->markers)
      add_dictionary(marker.dictionary, by_family);
  }
  return largest_of(by_family);
}

std::vector<std::string> largest_dictionaries() {
  Families by_family;
  for (const std::string& name : marker_dictionaries()) add_dictionary(name, by_family);
  return largest_of(by_family);
}

}  // namespace vantage
