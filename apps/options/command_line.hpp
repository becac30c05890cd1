#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "options/field.hpp"

namespace vantage {

/// Adds the options of all fields that have one. What the command line gives is collected in
/// `given`, an object of the fields' keys, for `read_given` to put over what a file says.
/// @param given outlives `verb`'s parsing.
void add_fields(CLI::App& verb, const FieldGroup& group, nlohmann::json& given);

}  // namespace vantage
