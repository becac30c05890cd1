#include "documents/yaml_document.hpp"

#include <fmt/format.h>
#include <yaml.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <optional>
#include <vector>

#include "documents/document_builder.hpp"
#include "documents/yaml_scalar.hpp"
#include "vantage/raycore/detail/file.hpp"

namespace vantage {
namespace {

constexpr std::string_view kStandardTag = "tag:yaml.org,2002:";  // "!!" is short for it

/// One event of libyaml's, freed with its owner.
class YamlEvent {
 public:
  YamlEvent() = default;
  ~YamlEvent() { yaml_event_delete(&event_); }
  YamlEvent(const YamlEvent&) = delete;
  YamlEvent& operator=(const YamlEvent&) = delete;

  yaml_event_t* get() { return &event_; }
  const yaml_event_t* operator->() const { return &event_; }

  TextPosition position() const {
    return {int(event_.start_mark.line) + 1, int(event_.start_mark.column) + 1};
  }

 private:
  yaml_event_t event_ = {};
};

std::string text_or_empty(const yaml_char_t* text) {
  return text == nullptr ? std::string() : reinterpret_cast<const char*>(text);
}

/// libyaml's parser over one text. It keeps its state on the heap, so that depth costs no stack.
class YamlParser {
 public:
  YamlParser(std::string_view text, const std::string& name) : text_(text), name_(name) {
    if (yaml_parser_initialize(&parser_) == 0) throw std::bad_alloc();
    const char* start = text.empty() ? "" : text.data();  // null ends the process
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(start),
                                 text.size());
  }
  ~YamlParser() { yaml_parser_delete(&parser_); }
  YamlParser(const YamlParser&) = delete;
  YamlParser& operator=(const YamlParser&) = delete;

  /// @throws Error bad_input with file:line:column for what is no valid YAML.
  void next(YamlEvent& event) {
    if (yaml_parser_parse(&parser_, event.get()) == 0) fail();
  }

 private:
  [[noreturn]] void fail() const {
    if (parser_.error == YAML_MEMORY_ERROR) throw std::bad_alloc();
    if (parser_.error == YAML_READER_ERROR) {
      throw bad_input(place_in_text(name_, position_of(parser_.problem_offset)),
                      fmt::format("invalid YAML: {} (0x{:02x}); expected UTF-8 text",
                                  parser_.problem, parser_.problem_value));
    }
    const TextPosition at{int(parser_.problem_mark.line) + 1, int(parser_.problem_mark.column) + 1};
    std::string reason = parser_.problem;
    if (parser_.context != nullptr) {
      reason += fmt::format(" {}, line {}", parser_.context, parser_.context_mark.line + 1);
    }
    throw bad_input(place_in_text(name_, at), "invalid YAML: " + reason);
  }

  /// Of a byte of the text.
  TextPosition position_of(std::size_t byte) const {
    TextPosition at{1, 1};
    for (std::size_t i = 0; i < std::min(byte, text_.size()); ++i) {
      const bool ends_line =
          text_[i] == '\n' || (text_[i] == '\r' && text_.substr(i + 1, 1) != "\n");
      at = ends_line ? TextPosition{at.line + 1, 1} : TextPosition{at.line, at.column + 1};
    }
    return at;
  }

  std::string_view text_;
  const std::string& name_;
  yaml_parser_t parser_ = {};
};

/// Hands libyaml's events to a builder.
class YamlReader {
 public:
  YamlReader(const std::string& name, const YamlOptions& options, const StopToken& stop)
      : name_(name), ignore_tags_(options.ignore_tags), builder_(name, options.limits, stop) {}

  Document read(YamlParser& parser) {
    while (true) {
      YamlEvent event;
      parser.next(event);
      if (event->type == YAML_STREAM_END_EVENT) break;
      handle(event);
    }
    Document document = builder_.finish();
    if (document.root.is_null()) throw bad_input(name_, "the file is empty; expected YAML");
    return document;
  }

 private:
  void handle(const YamlEvent& event) {
    const TextPosition at = event.position();
    switch (event->type) {
      case YAML_DOCUMENT_START_EVENT:
        if (++documents_ > 1) builder_.fail(at, "a second document begins; expected one per file");
        break;
      case YAML_MAPPING_START_EVENT:
        check_tag(text_or_empty(event->data.mapping_start.tag), "map", at);
        builder_.begin_map(at, text_or_empty(event->data.mapping_start.anchor));
        break;
      case YAML_SEQUENCE_START_EVENT:
        check_tag(text_or_empty(event->data.sequence_start.tag), "seq", at);
        builder_.begin_list(at, text_or_empty(event->data.sequence_start.anchor));
        break;
      case YAML_MAPPING_END_EVENT:
      case YAML_SEQUENCE_END_EVENT:
        builder_.end();
        break;
      case YAML_ALIAS_EVENT:
        builder_.alias(text_or_empty(event->data.alias.anchor), at);
        break;
      case YAML_SCALAR_EVENT:
        scalar(event, at);
        break;
      default:  // begin of the stream, end of the document
        break;
    }
  }

  void scalar(const YamlEvent& event, TextPosition at) {
    const auto& scalar = event->data.scalar;
    const std::string text(reinterpret_cast<const char*>(scalar.value), scalar.length);
    const std::string anchor = text_or_empty(scalar.anchor);
    const bool plain = scalar.style == YAML_PLAIN_SCALAR_STYLE;
    if (builder_.expects_key()) {
      if (plain && text == "<<") return builder_.merge_key(at);
      return builder_.key(text, at);
    }
    builder_.value(typed(text, text_or_empty(scalar.tag), plain, at), at, anchor);
  }

  nlohmann::json typed(const std::string& text, const std::string& tag, bool plain,
                       TextPosition at) const {
    const bool standard = tag.starts_with(kStandardTag);
    const std::string kind = standard ? tag.substr(kStandardTag.size()) : "";
    if (kind == "str" || tag == "!") return text;
    const bool asks_for_type = kind == "int" || kind == "float" || kind == "bool" || kind == "null";
    if (!asks_for_type) {
      check_tag(tag, "str", at);
      if (!plain) return text;
    }
    const std::optional<nlohmann::json> value = core_scalar(text);
    if (!value) builder_.fail(at, fmt::format("found {}: out of range", shown(text)));
    if (kind == "float" && value->is_number()) return value->get<double>();
    if ((kind == "int" && !value->is_number_integer()) || (kind == "float") ||
        (kind == "bool" && !value->is_boolean()) || (kind == "null" && !value->is_null())) {
      builder_.fail(
          at, fmt::format("found {}; expected {}, as its tag !!{} says", shown(text), kind, kind));
    }
    return *value;
  }

  void check_tag(const std::string& tag, std::string_view allowed, TextPosition at) const {
    if (tag.empty() || tag == "!" || ignore_tags_) return;
    if (tag == std::string(kStandardTag).append(allowed)) return;
    builder_.fail(at, fmt::format("unknown tag {}; remove it", tag));
  }

  const std::string& name_;
  bool ignore_tags_;
  int documents_ = 0;
  DocumentBuilder builder_;
};

}  // namespace

Document parse_yaml(std::string_view text, const std::string& name, const YamlOptions& options,
                    const StopToken& stop) {
  if (text.size() > options.limits.max_bytes) {
    throw bad_input(
        name, fmt::format("has {} bytes; the limit is {}", text.size(), options.limits.max_bytes));
  }
  std::string without_header;
  if (options.ignore_tags && text.starts_with("%YAML")) {
    without_header = text;
    without_header.front() = '#';  // a comment: lines and columns stay what they are
    text = without_header;
  }
  YamlParser parser(text, name);
  return YamlReader(name, options, stop).read(parser);
}

Document read_yaml(const std::filesystem::path& path, const YamlOptions& options,
                   const StopToken& stop) {
  const std::vector<std::uint8_t> bytes = read_file(path, options.limits.max_bytes);
  return parse_yaml({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string(),
                    options, stop);
}

}  // namespace vantage
