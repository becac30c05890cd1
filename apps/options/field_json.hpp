#pragma once

#include <nlohmann/json.hpp>

#include "documents/document_value.hpp"
#include "options/field.hpp"

namespace vantage {

/// The values of all fields, for `config`: null where one is not set.
nlohmann::ordered_json to_json(const FieldGroup& group);

/// Sets the fields that `value` has; the others stay.
/// @throws Error bad_input, with the value's place, for a number out of its range or not finite.
void read_fields(const Value& value, const FieldGroup& group);

/// The same from what the command line gave (command_line.hpp).
void read_given(const nlohmann::json& given, const FieldGroup& group);

/// JSON Schema of the object with these fields: types, ranges, defaults, help.
nlohmann::ordered_json schema_of(const FieldGroup& group);

}  // namespace vantage
