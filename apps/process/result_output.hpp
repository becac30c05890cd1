#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "vantage/raycore/error.hpp"

namespace vantage {

/// Prints text for people on stdout, all of it, and printable.
/// @throws Error out_of_resources for a full disk, a reader that is gone, a stdout that is closed.
void print_text(const std::string& text);

/// Prints a command's result: the JSON for machines, or what `summary` says for people.
/// @throws Error as `print_text`.
void print_result(bool as_json, const nlohmann::ordered_json& json,
                  const std::function<std::string()>& summary);

/// The same for commands that have files to write after it: nothing, or the error to throw then.
[[nodiscard]] std::optional<Error> try_print_result(bool as_json,
                                                    const nlohmann::ordered_json& json,
                                                    const std::function<std::string()>& summary);

/// The text of a JSON file of ours. Bytes that are not UTF-8, which paths may contain, are
/// replaced.
template <class Json>
std::string json_text(const Json& json) {
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace vantage
