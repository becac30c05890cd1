#include "documents/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
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
    std::size_t index = 0;
    const char* const end = token->data() + token->size();
    const auto [stop, error] = std::from_chars(token->data(), end, index);
    if (node != nullptr && node->is_array() && error == std::errc() && stop == end) {
      path += "[" + *token + "]";
      node = index < node->size() ? &(*node)[index] : nullptr;
    } else {
      path += (path.empty() ? "" : ".") + *token;
      node = node != nullptr && node->is_object() && node->contains(*token) ? &(*node)[*token]
                                                                            : nullptr;
    }
  }
  return path;
}

}  // namespace

std::uint64_t LineMap::hash(std::string_view text, std::uint64_t so_far) {
  constexpr std::uint64_t kPrime = 0x100000001b3;  // FNV-1a's
  for (const char c : text) so_far = (so_far ^ static_cast<unsigned char>(c)) * kPrime;
  return so_far;
}

void LineMap::finish() {
  // What was said first of a value holds, as with a key and its value in the next line.
  std::stable_sort(lines_.begin(), lines_.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
}

std::optional<int> LineMap::find_hash(std::uint64_t wanted) const {
  const auto found = std::lower_bound(lines_.begin(), lines_.end(), wanted,
                                      [](const auto& a, std::uint64_t b) { return a.first < b; });
  if (found == lines_.end() || found->first != wanted) return std::nullopt;
  return found->second;
}

std::optional<int> Document::line(const std::string& pointer) const {
  for (std::string_view at = pointer;; at = at.substr(0, at.rfind('/'))) {
    const std::optional<int> found = lines.find(at);
    if (found || at.empty()) return found;
  }
}

std::string Document::place(const std::string& pointer) const {
  std::string text = name;
  if (const std::optional<int> found = line(pointer)) text += fmt::format(":{}", *found);
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
