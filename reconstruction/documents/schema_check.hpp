#pragma once

#include <nlohmann/json.hpp>

#include "documents/document.hpp"

namespace vantage {

/// Throws unless `document` is what `schema` (JSON Schema draft 7) describes.
///
/// Unknown keys, missing keys and wrong types are looked for first, from the top down, where the
/// message can name the nearest known key; valijson checks all the rest. Of the schema's ways to
/// describe a key, `properties`, `items`, `additionalProperties`, `$ref` within the schema and `if`
/// with `then` and `else` are followed.
/// @throws Error bad_input with file, line and key; the value found and what is expected.
void check_schema(const Document& document, const nlohmann::json& schema);

}  // namespace vantage
