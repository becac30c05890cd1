#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "documents/document.hpp"
#include "documents/document_limits.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// Reads untrusted JSON (RFC 8259; a byte order mark is skipped).
/// @throws Error bad_input with file:line:column for invalid JSON, a number that fits no double,
/// invalid UTF-8, and what exceeds the limits; with file:line for a key that is there twice; for an
/// empty file, one that is missing or too large. Error cancelled if `stop` was.
Document read_json(const std::filesystem::path& path, const DocumentLimits& limits = kJsonLimits,
                   const StopToken& stop = {});

/// The same for text; `name` is for the messages, and the text begins in line `first_line`.
Document parse_json(std::string_view text, const std::string& name,
                    const DocumentLimits& limits = kJsonLimits, const StopToken& stop = {},
                    int first_line = 1);

/// JSON where the file's name ends in .json, YAML otherwise.
Document read_document(const std::filesystem::path& path, const StopToken& stop = {});

}  // namespace vantage
