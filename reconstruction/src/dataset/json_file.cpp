#include "dataset/json_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxJsonBytes = std::size_t(64) << 20;
constexpr int kMaxDepth = 64;

/// A text, and where it stands.
struct Source {
  const std::filesystem::path& path;
  std::string_view text;
  std::optional<int> line = {};  ///< from 1; without one, the text is the whole file

  std::string name() const {
    return line ? fmt::format("{}:{}", path.string(), *line) : path.string();
  }
};

/// "file:line:column" of a byte of the text; both count from 1.
std::string place(const Source& source, std::size_t byte) {
  const std::string_view before = source.text.substr(0, std::min(byte, source.text.size()));
  const auto line = source.line.value_or(1) + std::count(before.begin(), before.end(), '\n');
  const std::size_t line_end = before.rfind('\n');  // npos + 1 == 0
  return fmt::format("{}:{}:{}", source.path.string(), line, before.size() - (line_end + 1) + 1);
}

/// nlohmann's values are copied and printed by recursion: deep nesting would overflow the stack.
void check_depth(const Source& source) {
  const std::string_view text = source.text;
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMaxDepth) {
        throw bad_input(
            place(source, i),
            fmt::format("nested deeper than {} levels; no file that vantage reads is", kMaxDepth));
      }
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
}

/// Without nlohmann's own prefix, "[json.exception.…] parse error at line 1, column 2: ".
std::string reason(const json::parse_error& error) {
  std::string text = error.what();
  const std::size_t column = text.find("column ");
  const std::size_t start = text.find(": ", column == std::string::npos ? 0 : column);
  return start == std::string::npos ? text : text.substr(start + 2);
}

json parse(const Source& source) {
  check_depth(source);
  std::vector<std::set<std::string>> open_objects;  // the keys of each so far
  const auto refuse_duplicates = [&](int, json::parse_event_t event, json& parsed) {
    if (event == json::parse_event_t::object_start) open_objects.emplace_back();
    if (event == json::parse_event_t::object_end) open_objects.pop_back();
    if (event == json::parse_event_t::key &&
        !open_objects.back().insert(parsed.get<std::string>()).second) {
      throw bad_input(fmt::format("{}: {}", source.name(), parsed.dump()),
                      "this key is there twice in one object; remove one of them");
    }
    return true;
  };
  try {
    return json::parse(source.text, refuse_duplicates);
  } catch (const json::parse_error& error) {
    // `byte` counts what was read, the offending character included.
    throw bad_input(place(source, error.byte == 0 ? 0 : error.byte - 1),
                    fmt::format("no valid JSON, or truncated: {}", reason(error)));
  } catch (const json::exception& error) {
    throw bad_input(source.name(), fmt::format("no usable JSON: {}", error.what()));
  }
}

}  // namespace

json parse_json_file(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_file(path, kMaxJsonBytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    throw bad_input(path.string(), "the file is empty; expected JSON");
  }
  return parse({path, text});
}

json parse_json_line(const std::filesystem::path& path, int line, std::string_view text) {
  return parse({path, text, line});
}

}  // namespace vantage::reconstruction::detail
