#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "documents/document.hpp"

namespace vantage {

/// Reads one YAML document. Plain scalars are typed by YAML 1.2's core schema (`yes` is a string,
/// `true` a bool); quoted ones are strings. Aliases are expanded.
/// @throws Error bad_input with file:line:column for a syntax error; with file:line for a key that
/// is there twice, a key that is no scalar, an unknown tag, a number out of range, nesting deeper
/// than 64, and aliases that expand to more than 100,000 values; for an empty file, several
/// documents in one file, a file above 16 MiB or none at all.
Document read_yaml(const std::filesystem::path& path);

/// The same for text; `name` is for the messages.
Document parse_yaml(std::string_view text, const std::string& name);

}  // namespace vantage
