#include "marker_dictionaries.hpp"

#include <map>

namespace vantage {

std::vector<std::string> dictionaries_of(const Workcell& workcell) {
  std::map<std::string, std::string> by_family;  // the knowledge base allows one name of each
  const auto add = [&](const Marker& marker) {
    by_family.try_emplace(marker_family(marker.dictionary), marker.dictionary);
  };
  for (const TypePtr& type : workcell.knowledge->types()) {
    for (const Marker& marker : type->markers()) add(marker);
  }
  if (workcell.board) {
    for (const Marker& marker : workcell.board->markers) add(marker);
  }
  std::vector<std::string> names;
  for (const auto& [family, name] : by_family) names.push_back(name);
  return names;
}

}  // namespace vantage
