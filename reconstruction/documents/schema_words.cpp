#include "documents/schema_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace vantage {
namespace {

using nlohmann::json;

const json& follow(const json& root, const json& schema) {
  const json* at = &schema;
  while (at->is_object() && at->contains("$ref")) {
    at = &root.at(json::json_pointer((*at)["$ref"].get<std::string>().substr(1)));
  }
  return *at;
}

bool holds(const json& condition, const json& value) {
  if (!value.is_object()) return true;
  for (const json& key : condition.value("required", json::array())) {
    if (!value.contains(key.get<std::string>())) return false;
  }
  const json properties = condition.value("properties", json::object());
  for (const auto& [key, schema] : properties.items()) {
    if (value.contains(key) && value[key] != schema.at("const")) return false;
  }
  return true;
}

std::string type_in_words(const std::string& type, bool plural) {
  if (type == "null") return "null";
  const std::string noun = type == "integer"   ? "whole number"
                           : type == "boolean" ? "true or false"
                                               : type;
  if (type == "boolean") return noun;
  if (plural) return noun + "s";
  return (type == "array" || type == "object" ? "an " : "a ") + noun;
}

std::string types_in_words(const json& type, bool plural) {
  if (type.is_string()) return type_in_words(type.get<std::string>(), plural);
  std::vector<std::string> words;
  for (const json& one : type) words.push_back(type_in_words(one.get<std::string>(), plural));
  return fmt::format("{}", fmt::join(words, " or "));
}

std::string limits_in_words(const json& schema) {
  std::vector<std::string> limits;
  const auto add = [&](const char* key, const char* sign) {
    if (schema.contains(key)) limits.push_back(fmt::format("{} {}", sign, schema[key].dump()));
  };
  add("exclusiveMinimum", ">");
  add("minimum", ">=");
  add("exclusiveMaximum", "<");
  add("maximum", "<=");
  return limits.empty() ? "" : fmt::format(" {}", fmt::join(limits, " and "));
}

std::string array_in_words(const json& root, const json& schema) {
  const std::size_t least = schema.value("minItems", std::size_t(0));
  const std::size_t most = schema.value("maxItems", std::size_t(0));
  std::string count = least == most && least > 0 ? fmt::format("{} ", least)
                      : most > 0                 ? fmt::format("{} to {} ", least, most)
                      : least > 0                ? fmt::format("{} or more ", least)
                                                 : "";
  if (!schema.contains("items")) return fmt::format("an array of {}elements", count);
  const json& any = follow(root, schema["items"]);
  const json& items = any.contains("if") ? follow(root, any["then"]) : any;
  return fmt::format("an array of {}{}{}", count,
                     types_in_words(items.value("type", json("value")), true),
                     limits_in_words(items));
}

std::string values_in_words(const json& schema) {
  std::vector<std::string> values;
  for (const json& value : schema["enum"]) values.push_back(value.dump());
  return fmt::format("one of {}", fmt::join(values, ", "));
}

/// For the pattern `"oneOf": [{"required": ["box"]}, {"required": ["mesh", "unit_m"]}]`, which may
/// have names as its first choice: `{"enum": ["none"]}`.
std::string choices_in_words(const json& schema) {
  std::vector<std::string> choices;
  std::string names;
  for (const json& choice : schema["oneOf"]) {
    if (choice.contains("enum")) {
      names = values_in_words(choice) + ", or ";
      continue;
    }
    std::vector<std::string> keys;
    for (const json& key : choice.value("required", json::array())) keys.push_back(key.dump());
    choices.push_back(fmt::format("{}", fmt::join(keys, " with ")));
  }
  return fmt::format("{}exactly one of the keys {}", names, fmt::join(choices, ", "));
}

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

const json& resolve(const json& root, const json& schema, const json& value) {
  const json* at = &follow(root, schema);
  while (at->is_object() && at->contains("if")) {
    at = &follow(root, at->at(holds((*at)["if"], value) ? "then" : "else"));
  }
  return *at;
}

const json& schema_at(const json& root, const json& document, const json::json_pointer& at) {
  if (at.empty()) return resolve(root, root, document);
  const json& parent = schema_at(root, document, at.parent_pointer());
  const json& value = document.at(at);
  if (parent.contains("properties") && parent["properties"].contains(at.back())) {
    return resolve(root, parent["properties"][at.back()], value);
  }
  for (const char* others : {"items", "additionalProperties"}) {
    if (parent.contains(others)) return resolve(root, parent[others], value);
  }
  return parent;
}

std::string in_words(const json& root, const json& schema) {
  if (schema.contains("enum")) return values_in_words(schema);
  if (schema.contains("oneOf")) return choices_in_words(schema);
  if (!schema.contains("type")) return schema.value("description", "something else");
  const json& type = schema["type"];
  if (type == "array") return array_in_words(root, schema);
  std::string words = types_in_words(type, false) + limits_in_words(schema);
  if (schema.contains("pattern")) words += " like " + schema["pattern"].get<std::string>();
  if (schema.contains("minLength")) words += " that is not empty";
  return words;
}

std::string nearest_key(const std::string& key, const json& properties) {
  constexpr std::size_t kLongestKey = 64;
  if (key.size() > kLongestKey) return {};
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, key.size() / 2) + 1;
  for (const auto& [known, unused] : properties.items()) {
    const std::size_t distance = edit_distance(key, known);
    if (distance < least) least = distance, nearest = known;
  }
  return nearest;
}

}  // namespace vantage
