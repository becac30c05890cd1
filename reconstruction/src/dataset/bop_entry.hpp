#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {

/// A value as the user wrote it, cut off where it gets long.
inline std::string excerpt(const nlohmann::json& value) {
  std::size_t longest = 60;
  std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (text.size() > longest) {
    while ((text[longest] & 0xC0) == 0x80) --longest;  // not within a character of UTF-8
    text = text.substr(0, longest) + "…";
  }
  return text;
}

/// @throws Error bad_input with `where` as the place for anything but an array of `kCount` numbers.
template <std::size_t kCount>
std::array<double, kCount> numbers_of(const nlohmann::json& found, const std::string& where) {
  const bool fits = found.is_array() && found.size() == kCount &&
                    std::all_of(found.begin(), found.end(),
                                [](const nlohmann::json& number) { return number.is_number(); });
  if (!fits) {
    throw bad_input(where,
                    fmt::format("found {}{}; expected {} numbers",
                                found.is_array() ? fmt::format("{} values, ", found.size()) : "",
                                excerpt(found), kCount));
  }
  return found.get<std::array<double, kCount>>();
}

/// The id that a key is, of an image or a model as `what` says.
/// @throws Error bad_input with `where` as the place if it is none.
inline int id_of(const std::string& key, const char* what, const std::string& where) {
  int id = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), id);
  if (error != std::errc{} || end != key.data() + key.size() || id < 0) {
    throw bad_input(where,
                    fmt::format("not a valid {} id; expected a whole number such as \"20\"", what));
  }
  return id;
}

/// One image's part of scene_camera.json; knows its place for the messages.
class Entry {
 public:
  Entry(const std::filesystem::path& file, const std::string& id, const nlohmann::json& value)
      : value_(value), where_(fmt::format("{}: \"{}\"", file.string(), id)) {
    if (!value.is_object()) {
      throw bad_input(where_, fmt::format("found {}; expected an object with cam_K and the other "
                                          "keys of one image",
                                          excerpt(value)));
    }
  }

  const std::string& where() const { return where_; }
  std::string where(const char* key) const { return where_ + ": " + key; }
  bool has(const char* key) const { return value_.contains(key); }

  template <std::size_t kCount>
  std::array<double, kCount> numbers(const char* key) const {
    return numbers_of<kCount>(required(key), where(key));
  }

  double positive(const char* key) const {
    const nlohmann::json& found = required(key);
    if (!found.is_number() || !(found.get<double>() > 0)) {
      throw bad_input(where(key), fmt::format("found {}; expected a number > 0", excerpt(found)));
    }
    return found.get<double>();
  }

 private:
  const nlohmann::json& required(const char* key) const {
    const auto found = value_.find(key);
    if (found == value_.end()) throw bad_input(where(key), "missing; every image needs it");
    return *found;
  }

  const nlohmann::json& value_;
  std::string where_;
};

}  // namespace vantage::reconstruction::detail
