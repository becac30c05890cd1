#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>

#include "vantage/raycore/error.hpp"

namespace vantage {

/// Maps the JSON pointer of a value ("/boxes/0/min_m"; "" is the root) to its line, from 1.
using LineMap = std::unordered_map<std::string, int>;

/// A file of settings: its values, and where in the file each one stands.
struct Document {
  std::string name;  ///< the file's path, for messages
  nlohmann::json root;
  LineMap lines = {};  ///< may be empty: places then have no line

  /// The place of a value, or of a key that is missing, e.g. "cell.yaml:7: boxes[0].min_m".
  std::string place(const std::string& pointer) const;
};

/// The pointer of a key or an element inside the value at `pointer`.
std::string child(const std::string& pointer, const std::string& key);
std::string child(const std::string& pointer, std::size_t index);

/// A value as the user would write it, cut off where it gets long; with its type where that may
/// not be plain to see: `"5" (a string)`.
std::string shown(const nlohmann::json& value);

}  // namespace vantage
