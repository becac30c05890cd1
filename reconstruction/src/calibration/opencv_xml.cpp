#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <pugixml.hpp>

#include "calibration/calibration_document.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

using nlohmann::json;

constexpr int kMaxXmlDepth = 64;

json word_value(std::string_view word) {
  std::string_view digits = word;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  const char *begin = digits.data(), *end = begin + digits.size();
  std::int64_t whole = 0;
  if (const auto [rest, error] = std::from_chars(begin, end, whole);
      error == std::errc() && rest == end) {
    return whole;
  }
  double number = 0;
  const auto [rest, error] = std::from_chars(begin, end, number);
  if (error == std::errc() && rest == end) return number;
  return std::string(word);
}

json text_value(std::string_view text) {
  constexpr std::string_view kSpaces = " \t\r\n";
  json words = json::array();
  for (std::size_t at = text.find_first_not_of(kSpaces); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kSpaces, at), text.size());
    words.push_back(word_value(text.substr(at, end - at)));
    at = text.find_first_not_of(kSpaces, end);
  }
  if (words.empty()) return nullptr;
  return words.size() == 1 ? words[0] : words;
}

/// Turns elements into values; the depth is limited before the stack is.
class XmlConverter {
 public:
  explicit XmlConverter(const std::string& name) : name_(name) {}

  json convert(const pugi::xml_node& node, int depth) const {
    if (depth > kMaxXmlDepth) {
      throw bad_input(name_, fmt::format("nested deeper than {} levels", kMaxXmlDepth));
    }
    json members = json::object(), list = json::array();
    for (const pugi::xml_node& element : node.children()) {
      if (element.type() != pugi::node_element) continue;
      json value = convert(element, depth + 1);
      if (std::string_view(element.name()) == "_") {
        list.push_back(std::move(value));
      } else if (!members.emplace(element.name(), std::move(value)).second) {
        throw bad_input(name_ + ": " + element.name(), "is given twice; remove one of them");
      }
    }
    if (!members.empty()) return members;
    return list.empty() ? text_value(node.text().get()) : list;
  }

 private:
  const std::string& name_;
};

}  // namespace

Document parse_opencv_xml(std::string_view text, const std::string& name) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(text.data(), text.size());
  if (!result) {
    const std::string_view before =
        text.substr(0, std::size_t(std::max<std::ptrdiff_t>(result.offset, 0)));
    throw bad_input(fmt::format("{}:{}", name, 1 + std::ranges::count(before, '\n')),
                    fmt::format("invalid or truncated XML: {}", result.description()));
  }
  const pugi::xml_node storage = document.child("opencv_storage");
  if (!storage) {
    throw bad_input(name, fmt::format("its root is <{}>; expected <opencv_storage>, as OpenCV's "
                                      "cv::FileStorage writes it",
                                      document.first_child().name()));
  }
  return {name, XmlConverter(name).convert(storage, 0)};
}

}  // namespace vantage::reconstruction::detail
