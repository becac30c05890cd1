#include "documents/json_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

#include "documents/document_builder.hpp"
#include "documents/yaml_document.hpp"
#include "vantage/raycore/detail/file.hpp"

namespace vantage {
namespace {

/// A byte of the text for nlohmann's parser, which says nowhere how far it is: this does.
struct ObservedByte {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at;
  const char** furthest;

  reference operator*() const { return *at; }
  ObservedByte& operator++() {
    *furthest = ++at;
    return *this;
  }
  ObservedByte operator++(int) {
    const ObservedByte before = *this;
    ++*this;
    return before;
  }
  bool operator==(const ObservedByte& other) const { return at == other.at; }
  bool operator!=(const ObservedByte& other) const { return at != other.at; }
};

/// Lines and columns of a text, for positions that only grow.
class LineCounter {
 public:
  LineCounter(std::string_view text, int first_line) : text_(text), line_(first_line) {}

  /// Of the byte `end - 1`, or of the beginning.
  TextPosition position(std::size_t end) {
    const std::size_t last = end == 0 ? 0 : end - 1;
    for (; next_ < std::min(last, text_.size()); ++next_) {
      const bool is_break =
          text_[next_] == '\n' || (text_[next_] == '\r' && text_.substr(next_ + 1, 1) != "\n");
      if (!is_break) continue;
      ++line_;
      line_begin_ = next_ + 1;
    }
    return {line_, int(last - line_begin_) + 1};
  }

 private:
  std::string_view text_;
  int line_;
  std::size_t next_ = 0;
  std::size_t line_begin_ = 0;
};

/// Without nlohmann's own prefix, "[json.exception.…] parse error at line 1, column 2: ".
std::string reason_of(const nlohmann::json::exception& error) {
  constexpr std::size_t kLongest = 200;
  std::string text = error.what();
  const std::size_t column = text.find("column ");
  const std::size_t start = text.find(": ", column == std::string::npos ? 0 : column);
  if (start != std::string::npos) {
    text.erase(0, start + 2);
  } else {
    text.erase(0, text.find("] ") == std::string::npos ? 0 : text.find("] ") + 2);
  }
  return text.size() > kLongest ? text.substr(0, kLongest) + "…" : text;
}

/// What nlohmann's SAX parser calls; hands its events to a builder.
class JsonEvents {
 public:
  using Json = nlohmann::json;

  JsonEvents(std::string_view text, int first_line, DocumentBuilder& builder)
      : begin_(text.data()), reached_(begin_), lines_(text, first_line), builder_(builder) {}

  ObservedByte iterator(const char* at) { return {at, &reached_}; }

  bool null() { return value(nullptr); }
  bool boolean(bool x) { return value(x); }
  bool number_integer(Json::number_integer_t x) { return value(x); }
  bool number_unsigned(Json::number_unsigned_t x) { return value(x); }
  bool number_float(Json::number_float_t x, const std::string&) { return value(x); }
  bool string(std::string& text) { return value(std::move(text)); }
  bool binary(Json::binary_t&) { return false; }  // there is none in a text
  bool start_object(std::size_t) { return builder_.begin_map(position()), true; }
  bool start_array(std::size_t) { return builder_.begin_list(position()), true; }
  bool end_object() { return builder_.end(), true; }
  bool end_array() { return builder_.end(), true; }
  bool key(std::string& text) { return builder_.key(text, position()), true; }

  bool parse_error(std::size_t byte, const std::string&, const Json::exception& error) {
    builder_.fail(lines_.position(byte),
                  fmt::format("invalid or truncated JSON: {}", reason_of(error)));
  }

 private:
  /// A number's parser has read the byte behind it, too; nothing else ends in a line break.
  TextPosition position() { return lines_.position(std::size_t(reached_ - begin_)); }
  bool value(Json scalar) { return builder_.value(std::move(scalar), position()), true; }

  const char* begin_;
  const char* reached_;
  LineCounter lines_;
  DocumentBuilder& builder_;
};

}  // namespace

Document parse_json(std::string_view text, const std::string& name, const DocumentLimits& limits,
                    const StopToken& stop, int first_line) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    throw bad_input(name, "the file is empty; expected JSON");
  }
  DocumentBuilder builder(name, limits, stop);
  JsonEvents events(text, first_line, builder);
  nlohmann::json::sax_parse(events.iterator(text.data()),
                            events.iterator(text.data() + text.size()), &events);
  return builder.finish();
}

Document read_json(const std::filesystem::path& path, const DocumentLimits& limits,
                   const StopToken& stop) {
  const std::vector<std::uint8_t> bytes = read_file(path, limits.max_bytes);
  return parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string(),
                    limits, stop);
}

Document read_document(const std::filesystem::path& path, const StopToken& stop) {
  return path.extension() == ".json" ? read_json(path, kJsonLimits, stop)
                                     : read_yaml(path, {}, stop);
}

}  // namespace vantage
