// GCC 12 warns of an overlap in std::string::replace that does not exist (GCC bug 105329), here in
// valijson.
#ifndef __clang__
#pragma GCC diagnostic ignored "-Wrestrict"
#endif

#include "documents/schema_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>
#include <vector>

#include "documents/schema_words.hpp"

namespace vantage {
namespace {

using nlohmann::json;

bool is_of_type(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "integer") return value.is_number_integer();
  return value.is_number();
}

bool is_of_any_type(const json& value, const json& types) {
  if (types.is_string()) return is_of_type(value, types.get<std::string>());
  return std::any_of(types.begin(), types.end(),
                     [&](const json& type) { return is_of_type(value, type.get<std::string>()); });
}

/// The walk that finds the most frequent mistakes: keys and types.
class Walk {
 public:
  Walk(const Document& document, const json& root) : document_(document), root_(root) {}

  void check(const json& value, const json& any_schema, const std::string& pointer) const {
    static const json kAnything = json::object();  // what the schema `true` stands for
    const json& resolved = resolve(root_, any_schema, value);
    const json& schema = resolved.is_object() ? resolved : kAnything;
    if (schema.contains("type") && !is_of_any_type(value, schema["type"])) {
      json typed = schema;
      typed.erase("oneOf");  // which concerns the keys of something that is not an object
      fail(pointer, fmt::format("found {}; expected {}", shown(value), in_words(root_, typed)));
    }
    if (value.is_number_float() && !std::isfinite(value.get<double>())) {
      fail(pointer, fmt::format("found {}; expected a finite number", shown(value)));
    }
    if (value.is_object()) check_object(value, schema, pointer);
    if (value.is_array()) {
      const json& items = schema.contains("items") ? schema["items"] : kAnything;
      for (std::size_t i = 0; i < value.size(); ++i) check(value[i], items, child(pointer, i));
    }
  }

 private:
  [[noreturn]] void fail(const std::string& pointer, std::string message) const {
    throw bad_input(document_.place(pointer), std::move(message));
  }

  /// Unknown keys come before missing ones: a misspelt key is both.
  void check_object(const json& value, const json& schema, const std::string& pointer) const {
    const json properties = schema.value("properties", json::object());
    const json others = schema.value("additionalProperties", json(true));
    for (const auto& [key, unused] : value.items()) {
      if (others == false && !properties.contains(key)) fail_unknown(key, properties, pointer);
    }
    for (const json& key : schema.value("required", json::array())) {
      if (!value.contains(key.get<std::string>())) fail_missing(key, properties, pointer);
    }
    for (const auto& [key, element] : value.items()) {
      check(element, properties.contains(key) ? properties[key] : others, child(pointer, key));
    }
  }

  [[noreturn]] void fail_unknown(const std::string& key, const json& properties,
                                 const std::string& pointer) const {
    const std::string nearest = nearest_key(key, properties);
    if (!nearest.empty()) {
      fail(child(pointer, key), fmt::format("unknown key; did you mean \"{}\"?", nearest));
    }
    std::vector<std::string> known;
    for (const auto& [name, unused] : properties.items()) known.push_back(name);
    fail(child(pointer, key),
         fmt::format("unknown key; the keys here are {}", fmt::join(known, ", ")));
  }

  [[noreturn]] void fail_missing(const std::string& key, const json& properties,
                                 const std::string& pointer) const {
    const json& schema = resolve(root_, properties.at(key), json());
    std::string message = fmt::format("missing; expected {}", in_words(root_, schema));
    if (properties.at(key).contains("description")) {
      message += ": " + properties.at(key)["description"].get<std::string>();
    }
    fail(child(pointer, key), std::move(message));
  }

  const Document& document_;
  const json& root_;
};

/// valijson's context, "<root>", "[boxes]", "[0]", as a JSON pointer.
json::json_pointer to_pointer(const std::vector<std::string>& context) {
  json::json_pointer pointer;
  for (std::size_t i = 1; i < context.size(); ++i) {
    pointer /= context[i].substr(1, context[i].size() - 2);
  }
  return pointer;
}

}  // namespace

void check_schema(const Document& document, const json& schema) {
  Walk(document, schema).check(document.root, schema, "");

  valijson::Schema compiled;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema),
                                          compiled);
  valijson::ValidationResults results;
  if (valijson::Validator().validate(
          compiled, valijson::adapters::NlohmannJsonAdapter(document.root), &results)) {
    return;
  }
  // Each error inside is followed by one for everything around it: the innermost says most.
  const auto inner = std::max_element(
      results.begin(), results.end(),
      [](const auto& a, const auto& b) { return a.context.size() < b.context.size(); });
  const json::json_pointer at = to_pointer(inner->context);
  throw bad_input(document.place(at.to_string()),
                  fmt::format("found {}; expected {}", shown(document.root.at(at)),
                              in_words(schema, schema_at(schema, document.root, at))));
}

}  // namespace vantage
