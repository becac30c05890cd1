#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vantage/raycore/error.hpp"

namespace vantage {

/// The lines, from 1, of a document's values. A value is named by its JSON pointer
/// ("/boxes/0/min_m";
/// "" is the root), of which only a hash is kept: a document may have a million values.
class LineMap {
 public:
  LineMap() = default;
  /// For a document that stands in one line.
  explicit LineMap(int line_of_root) { add(hash(""), line_of_root), finish(); }

  /// Of "a" and then "/b" is the hash of "a/b": `so_far` is what the text before it had.
  static std::uint64_t hash(std::string_view text, std::uint64_t so_far = kEmptyText);

  void add(std::uint64_t pointer_hash, int line) { lines_.emplace_back(pointer_hash, line); }
  void finish();  ///< after the last `add`, before the first `find`

  /// The line that was added for exactly this pointer.
  std::optional<int> find(std::string_view pointer) const { return find_hash(hash(pointer)); }
  std::optional<int> find_hash(std::uint64_t pointer_hash) const;

 private:
  static constexpr std::uint64_t kEmptyText = 0xcbf29ce484222325;  // FNV-1a's offset

  std::vector<std::pair<std::uint64_t, int>> lines_;  // sorted: no choice of keys makes this slow
};

/// A file of settings: its values, and where in the file each one stands.
struct Document {
  std::string name;  ///< the file's path, for messages
  nlohmann::json root;
  LineMap lines = {};  ///< may be empty: places then have no line

  /// The line of a value; of one that is missing, or that came through an alias, the line of the
  /// nearest one around it.
  std::optional<int> line(const std::string& pointer) const;

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
