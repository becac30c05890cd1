#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vantage {

/// Follows `$ref: "#/definitions/…"` within the schema `root`, and `if` to the `then` or the `else`
/// that is for `value`. Of conditions, `required` and a `const` of `properties` are known.
const nlohmann::json& resolve(const nlohmann::json& root, const nlohmann::json& schema,
                              const nlohmann::json& value);

/// The part of a schema that describes the value at a JSON pointer of a document.
const nlohmann::json& schema_at(const nlohmann::json& root, const nlohmann::json& document,
                                const nlohmann::json::json_pointer& at);

/// What a schema expects, in words: "an array of 3 numbers > 0".
std::string in_words(const nlohmann::json& root, const nlohmann::json& schema);

/// The known key that was most likely meant; empty if none is close.
std::string nearest_key(const std::string& key, const nlohmann::json& properties);

}  // namespace vantage
