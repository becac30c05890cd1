#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vantage {

/// Follows `$ref: "#/definitions/…"` within the schema `root`.
const nlohmann::json& resolve(const nlohmann::json& root, const nlohmann::json& schema);

/// The part of a schema that describes the value at a JSON pointer.
const nlohmann::json& schema_at(const nlohmann::json& root, const nlohmann::json::json_pointer& at);

/// What a schema expects, in words: "an array of 3 numbers > 0".
std::string in_words(const nlohmann::json& root, const nlohmann::json& schema);

/// The known key that was most likely meant; empty if none is close.
std::string nearest_key(const std::string& key, const nlohmann::json& properties);

}  // namespace vantage
