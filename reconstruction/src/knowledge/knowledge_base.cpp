#include "vantage/reconstruction/knowledge_base.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "documents/schema_words.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {

std::vector<TypePtr> KnowledgeBase::types_that_are(std::string_view ancestor) const {
  std::vector<TypePtr> found;
  for (const TypePtr& type : types()) {
    if (is_a(type->name, ancestor)) found.push_back(type);
  }
  return found;
}

TypePtr KnowledgeBase::get(const std::string& name, const std::string& where) const {
  if (TypePtr type = find(name)) return type;
  if (types().empty()) {
    throw bad_input(where, fmt::format("found the type \"{}\", but there is no knowledge base, or "
                                       "it is empty; the workcell's key knowledge_base names its "
                                       "file",
                                       name));
  }
  nlohmann::json names = nlohmann::json::object();
  std::vector<std::string> known;
  for (const TypePtr& type : types()) {
    names[type->name] = true;
    known.push_back(type->name);
  }
  const std::string nearest = nearest_key(name, names);
  const std::string hint = nearest.empty() ? fmt::format("its types are {}", fmt::join(known, ", "))
                                           : fmt::format("did you mean \"{}\"?", nearest);
  throw bad_input(where, fmt::format("the knowledge base has no type \"{}\"; {}", name, hint));
}

}  // namespace vantage
