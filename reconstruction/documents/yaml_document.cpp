#include "documents/yaml_document.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <limits>
#include <optional>
#include <regex>
#include <vector>

#include "vantage/raycore/detail/file.hpp"

namespace vantage {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxYamlBytes = std::size_t(16) << 20;
constexpr int kMaxYamlDepth = 64;
constexpr std::size_t kMaxValues = 100'000;

int line_of(const YAML::Node& node) {
  return node.Mark().line + 1;
}

/// Digits in base 2 to 16, a sign in front allowed; nothing if it does not fit 64 bits.
std::optional<json> whole_number(std::string_view digits, int base) {
  std::int64_t value = 0;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, base);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

std::optional<json> real_number(std::string_view digits) {
  double value = 0;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

bool is_one_of(const std::string& text, std::initializer_list<const char*> words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

/// YAML 1.2.2, section 10.3.2. Nothing for a number that is out of range.
std::optional<json> core_scalar(const std::string& text) {
  static const std::regex octal("0o[0-7]+"), hexadecimal("0x[0-9a-fA-F]+"), whole("[-+]?[0-9]+"),
      real("[-+]?(\\.[0-9]+|[0-9]+(\\.[0-9]*)?)([eE][-+]?[0-9]+)?");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr std::size_t kLongestNumber = 400;  // std::regex recurses once per character

  if (is_one_of(text, {"", "~", "null", "Null", "NULL"})) return json(nullptr);
  if (is_one_of(text, {"true", "True", "TRUE"})) return json(true);
  if (is_one_of(text, {"false", "False", "FALSE"})) return json(false);
  if (is_one_of(text, {".inf", ".Inf", ".INF", "+.inf", "+.Inf", "+.INF"})) return json(kInfinity);
  if (is_one_of(text, {"-.inf", "-.Inf", "-.INF"})) return json(-kInfinity);
  if (is_one_of(text, {".nan", ".NaN", ".NAN"})) {
    return json(std::numeric_limits<double>::quiet_NaN());
  }
  if (text.size() > kLongestNumber) return json(text);
  if (std::regex_match(text, octal)) return whole_number(std::string_view(text).substr(2), 8);
  if (std::regex_match(text, hexadecimal))
    return whole_number(std::string_view(text).substr(2), 16);
  if (std::regex_match(text, whole)) {
    const std::optional<json> value = whole_number(text, 10);
    return value ? value : real_number(text);
  }
  if (std::regex_match(text, real)) return real_number(text);
  return json(text);
}

/// Turns a tree of yaml-cpp's into JSON and notes the lines.
class Converter {
 public:
  explicit Converter(Document& document) : document_(document) {}

  json convert(const YAML::Node& node, const std::string& pointer, int depth) {
    document_.lines.try_emplace(pointer, line_of(node));
    if (depth > kMaxYamlDepth) {
      // An alias to something that it is part of ends here, too.
      fail(node, fmt::format("nested deeper than {} levels", kMaxYamlDepth));
    }
    if (++values_ > kMaxValues) {
      fail(node, fmt::format("more than {} values, aliases expanded; expected a file of settings",
                             kMaxValues));
    }
    switch (node.Type()) {
      case YAML::NodeType::Map:
        return map(node, pointer, depth);
      case YAML::NodeType::Sequence:
        return sequence(node, pointer, depth);
      case YAML::NodeType::Scalar:
        return scalar(node);
      default:
        return nullptr;
    }
  }

 private:
  [[noreturn]] void fail(const YAML::Node& node, std::string message) const {
    throw bad_input(fmt::format("{}:{}", document_.name, line_of(node)), std::move(message));
  }

  json map(const YAML::Node& node, const std::string& pointer, int depth) {
    check_tag(node, "tag:yaml.org,2002:map");
    json object = json::object();
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) fail(entry.first, "a key that is no plain word");
      const std::string& key = entry.first.Scalar();
      const std::string at = child(pointer, key);
      if (object.contains(key)) {
        fail(entry.first, fmt::format("the key \"{}\" is there twice, first in line {}; remove one "
                                      "of them",
                                      key, document_.lines.at(at)));
      }
      document_.lines.emplace(at, line_of(entry.first));
      object[key] = convert(entry.second, at, depth + 1);
    }
    return object;
  }

  json sequence(const YAML::Node& node, const std::string& pointer, int depth) {
    check_tag(node, "tag:yaml.org,2002:seq");
    json array = json::array();
    for (const YAML::Node& element : node) {
      array.push_back(convert(element, child(pointer, array.size()), depth + 1));
    }
    return array;
  }

  /// yaml-cpp's tags: "!" for a quoted scalar, "?" or none for what has no tag.
  json scalar(const YAML::Node& node) const {
    const std::string& text = node.Scalar();
    if (node.Tag() == "!" || node.Tag() == "tag:yaml.org,2002:str") return text;
    check_tag(node, "tag:yaml.org,2002:str");
    std::optional<json> value = core_scalar(text);
    if (!value)
      fail(node, fmt::format("found {}; this number is out of range", text.substr(0, 60)));
    return *std::move(value);
  }

  void check_tag(const YAML::Node& node, std::string_view allowed) const {
    const std::string& tag = node.Tag();
    if (tag.empty() || tag == "?" || tag == "!" || tag == allowed) return;
    fail(node, fmt::format("unknown tag {}; remove it", tag));
  }

  Document& document_;
  std::size_t values_ = 0;
};

std::vector<YAML::Node> load(std::string_view text, const std::string& name) {
  try {
    return YAML::LoadAll(std::string(text));
  } catch (const YAML::Exception& error) {
    throw bad_input(fmt::format("{}:{}:{}", name, error.mark.line + 1, error.mark.column + 1),
                    fmt::format("no valid YAML: {}", error.msg));
  }
}

}  // namespace

Document parse_yaml(std::string_view text, const std::string& name) {
  const std::vector<YAML::Node> documents = load(text, name);
  if (documents.empty() || (documents.size() == 1 && documents[0].IsNull())) {
    throw bad_input(name, "the file is empty; expected YAML");
  }
  if (documents.size() > 1) {
    throw bad_input(fmt::format("{}:{}", name, line_of(documents[1])),
                    fmt::format("{} documents in one file; expected one", documents.size()));
  }
  Document document{name, {}};
  document.root = Converter(document).convert(documents[0], "", 0);
  return document;
}

Document read_yaml(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_file(path, kMaxYamlBytes);
  return parse_yaml({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string());
}

}  // namespace vantage
