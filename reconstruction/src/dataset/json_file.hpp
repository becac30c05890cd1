#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

namespace vantage::reconstruction::detail {

/// Parses a JSON file that nobody vouches for.
/// @throws Error bad_input with file:line:column for a syntax error and for nesting deeper than 64;
/// for a key that is there twice; for a file that is missing or above 64 MiB.
nlohmann::json parse_json_file(const std::filesystem::path& path);

/// The same for one line of a file of JSON lines; `line` counts from 1.
nlohmann::json parse_json_line(const std::filesystem::path& path, int line, std::string_view text);

}  // namespace vantage::reconstruction::detail
