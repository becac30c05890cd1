#include "mesh/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace vantage::raycore::detail {
namespace {

std::optional<PlyType> find_type(std::string_view name) {
  using enum PlyType;
  static constexpr std::array<std::pair<std::string_view, PlyType>, 16> kNames = {{
      {"char", int8},
      {"uchar", uint8},
      {"short", int16},
      {"ushort", uint16},
      {"int", int32},
      {"uint", uint32},
      {"float", float32},
      {"double", float64},
      {"int8", int8},
      {"uint8", uint8},
      {"int16", int16},
      {"uint16", uint16},
      {"int32", int32},
      {"uint32", uint32},
      {"float32", float32},
      {"float64", float64},
  }};
  const auto* found =
      std::ranges::find(kNames, name, [](const auto& entry) { return entry.first; });
  return found == kNames.end() ? std::nullopt : std::optional(found->second);
}

PlyType read_type(TextScanner& text) {
  const std::string_view word = text.word();
  if (const std::optional<PlyType> type = find_type(word)) return *type;
  text.fail(
      fmt::format("the property has the type {}; expected one of char, uchar, short, ushort, "
                  "int, uint, float, double, int8 … float64",
                  in_quotes(word)));
}

PlyFormat read_format(TextScanner& text) {
  const std::string_view name = text.word();
  const std::string_view version = text.word();
  if (version == "1.0") {
    if (name == "ascii") return PlyFormat::ascii;
    if (name == "binary_little_endian") return PlyFormat::little_endian;
    if (name == "binary_big_endian") return PlyFormat::big_endian;
  }
  text.fail(
      fmt::format("the format is {} {}; expected ascii, binary_little_endian or "
                  "binary_big_endian, version 1.0",
                  in_quotes(name), in_quotes(version)));
}

PlyElement read_element(TextScanner& text, const PlyHeader& header) {
  PlyElement element;
  element.name = text.word();
  const std::string_view word = text.word();
  const std::optional<std::int64_t> count = to_integer(word);
  if (!count || *count < 0) {
    text.fail(fmt::format("the element {} has the count {}; expected an integer, 0 or more",
                          in_quotes(element.name), in_quotes(word)));
  }
  if (header.find(element.name) != nullptr) {
    text.fail(fmt::format("the element {} is declared twice", in_quotes(element.name)));
  }
  element.count = std::uint64_t(*count);
  return element;
}

PlyProperty read_property(TextScanner& text) {
  PlyProperty property;
  TextScanner ahead = text;
  if (ahead.word() == "list") {
    text.word();
    property.count_type = read_type(text);
    if (*property.count_type >= PlyType::float32) {
      text.fail("the list's length is a floating-point number; expected an integer type");
    }
  }
  property.type = read_type(text);
  property.name = text.word();
  if (property.name.empty()) text.fail("the property has no name");
  return property;
}

void add_property(TextScanner& text, PlyHeader& header) {
  if (header.elements.empty()) text.fail("a property before the first element");
  std::vector<PlyProperty>& properties = header.elements.back().properties;
  PlyProperty property = read_property(text);
  if (std::ranges::find(properties, property.name, &PlyProperty::name) != properties.end()) {
    text.fail(fmt::format("the property {} is declared twice in the element {}",
                          in_quotes(property.name), in_quotes(header.elements.back().name)));
  }
  properties.push_back(std::move(property));
}

/// Moves on to the next line of the header.
void next_header_line(TextScanner& text) {
  if (!text.next_line()) text.fail("the file ends within the header; expected \"end_header\"");
}

/// The fewest bytes that one element can take. In ASCII a value takes a digit and what parts it
/// from the next value; an empty list is a single value.
std::uint64_t smallest_size(const PlyElement& element, PlyFormat format) {
  std::uint64_t size = 0;
  for (const PlyProperty& property : element.properties) {
    size += format == PlyFormat::ascii ? 2 : size_of(property.count_type.value_or(property.type));
  }
  return size;
}

}  // namespace

std::size_t size_of(PlyType type) {
  static constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[std::size_t(type)];
}

const PlyElement* PlyHeader::find(std::string_view name) const {
  const auto found = std::ranges::find(elements, name, &PlyElement::name);
  return found == elements.end() ? nullptr : &*found;
}

PlyHeader read_ply_header(TextScanner& text) {
  if (text.word() != "ply" || !text.word().empty()) {
    text.fail("the first line is not \"ply\"; expected a PLY file");
  }
  next_header_line(text);
  if (text.word() != "format") text.fail("expected \"format\" in the header's second line");
  PlyHeader header;
  header.format = read_format(text);
  while (true) {
    next_header_line(text);
    const std::string_view keyword = text.word();
    if (keyword == "end_header") break;
    if (keyword == "element") {
      header.elements.push_back(read_element(text, header));
    } else if (keyword == "property") {
      add_property(text, header);
    } else if (keyword != "comment" && keyword != "obj_info") {
      text.fail(
          fmt::format("the header has a line that begins with {}; expected comment, "
                      "obj_info, element, property or end_header",
                      in_quotes(keyword)));
    }
  }
  text.next_line();
  return header;
}

void check_ply_counts(const PlyHeader& header, std::uint64_t size, const std::string& file) {
  // The last value of an ASCII file needs nothing behind it.
  std::uint64_t left = size + (header.format == PlyFormat::ascii ? 1 : 0);
  for (const PlyElement& element : header.elements) {
    if (element.count == 0) continue;
    const std::uint64_t each = smallest_size(element, header.format);
    if (each == 0) {
      throw bad_input(file, fmt::format("the element {} has no properties; expected at least one",
                                        in_quotes(element.name)));
    }
    if (element.count > left / each) {
      throw bad_input(file, fmt::format("the header claims {} of the element {}, which take {} "
                                        "bytes each or more; the file has {} bytes left for them, "
                                        "so it is truncated or damaged",
                                        element.count, in_quotes(element.name), each, left));
    }
    left -= element.count * each;
  }
}

}  // namespace vantage::raycore::detail
