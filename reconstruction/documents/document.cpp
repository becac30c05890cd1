#include "documents/document.hpp"

#include <fmt/format.h>

#include <cmath>

namespace vantage {
namespace {

using nlohmann::json;

/// "/boxes/0/min_m" as people write it: "boxes[0].min_m". A number is an index only in an array.
std::string key_path(const json& root, const std::string& pointer) {
  std::string path;
  const json* node = &root;
  json::json_pointer rest(pointer);
  std::vector<std::string> tokens;
  for (; !rest.empty(); rest.pop_back()) tokens.push_back(rest.back());
  for (auto token = tokens.rbegin(); token != tokens.rend(); ++token) {
    if (node != nullptr && node->is_array()) {
      path += "[" + *token + "]";
      const std::size_t index = std::stoul(*token);
      node = index < node->size() ? &(*node)[index] : nullptr;
    } else {
      path += (path.empty() ? "" : ".") + *token;
      node = node != nullptr && node->contains(*token) ? &(*node)[*token] : nullptr;
    }
  }
  return path;
}

}  // namespace

std::string Document::place(const std::string& pointer) const {
  std::string text = name;
  // A missing key has no line: its nearest ancestor has.
  for (json::json_pointer at(pointer);; at.pop_back()) {
    const auto line = lines.find(at.to_string());
    if (line != lines.end()) text += fmt::format(":{}", line->second);
    if (line != lines.end() || at.empty()) break;
  }
  const std::string path = key_path(root, pointer);
  return path.empty() ? text : text + ": " + path;
}

std::string child(const std::string& pointer, const std::string& key) {
  return (json::json_pointer(pointer) / key).to_string();
}

std::string child(const std::string& pointer, std::size_t index) {
  return pointer + "/" + std::to_string(index);
}

std::string shown(const json& value) {
  std::size_t longest = 60;
  if (value.is_null()) return "nothing (null)";
  if (value.is_number_float() && !std::isfinite(value.get<double>())) {
    return fmt::format("{}", value.get<double>());  // nlohmann would write null
  }
  std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > longest) {
    while ((text[longest] & 0xC0) == 0x80) --longest;  // not within a character of UTF-8
    text = text.substr(0, longest) + "…";
  }
  return value.is_string() ? text + " (a string)" : text;
}

}  // namespace vantage
