#include <fmt/format.h>

#include "features/type_checks.hpp"
#include "knowledge/hierarchy.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"

namespace vantage {

MemoryKnowledgeBase::MemoryKnowledgeBase(std::vector<ObjectType> types, Hierarchy hierarchy) {
  std::map<std::string, std::string> places;  // of what names are
  for (const auto& [name, parents] : hierarchy) {
    reconstruction::detail::add_parents(parents_, name, parents);
    places[name] = "hierarchy: " + name;
  }
  for (ObjectType& type : types) {
    reconstruction::detail::check_type(type);
    const auto shared = std::make_shared<const ObjectType>(std::move(type));
    const auto [entry, is_new] = by_name_.try_emplace(shared->name, shared);
    if (!is_new) {
      throw bad_input(
          reconstruction::detail::place_of(*shared),
          fmt::format("the name \"{}\" is already used by {}; type names must be unique",
                      shared->name, reconstruction::detail::place_of(*entry->second)));
    }
    types_.push_back(shared);
    reconstruction::detail::add_parents(parents_, shared->name, shared->is_a);
    places[shared->name] = reconstruction::detail::place_of(*shared);
    for (std::size_t i = 0; i < shared->features.size(); ++i) {
      by_feature_[shared->features[i].key].push_back({shared, i});
    }
  }
  reconstruction::detail::check_no_circle(parents_, places);
}

TypePtr MemoryKnowledgeBase::find(std::string_view name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : found->second;
}

bool MemoryKnowledgeBase::is_a(std::string_view name, std::string_view ancestor) const {
  return reconstruction::detail::has_ancestor(parents_, name, ancestor);
}

const std::vector<TypeFeature>& MemoryKnowledgeBase::with_feature(const FeatureKey& key) const {
  static const std::vector<TypeFeature> kNone;
  const auto found = by_feature_.find(key);
  return found == by_feature_.end() ? kNone : found->second;
}

}  // namespace vantage
