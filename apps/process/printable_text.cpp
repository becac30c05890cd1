#include "process/printable_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace vantage {
namespace {

unsigned byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// How many bytes a character of UTF-8 has that begins with this one; 0: none does.
std::size_t expected_length(unsigned first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

/// The length of the character that the text begins with, if it may be printed; else 0.
std::size_t printable_length(std::string_view text) {
  const unsigned first = byte_at(text, 0);
  const std::size_t length = expected_length(first);
  if (length == 0 || length > text.size()) return 0;
  std::uint32_t code = length == 1 ? first : first & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte_at(text, i) & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte_at(text, i) & 0x3F);
  }
  constexpr std::uint32_t kShortest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool valid = code >= kShortest[length] && code <= 0x10FFFF && code - 0xD800 >= 0x800;
  const bool control = (code < 0x20 && code != '\n' && code != '\t') || (code - 0x7F) < 0x21 ||
                       code == 0x2028 || code == 0x2029 ||          // line ends that are none here
                       (code - 0x202A) < 5 || (code - 0x2066) < 4;  // turn what follows around
  return valid && !control ? length : 0;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = printable_length(text);
    if (length > 0) {
      result += text.substr(0, length);
    } else {
      result += fmt::format("\\x{:02x}", byte_at(text, 0));
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

std::string shortened(std::string_view text) {
  constexpr std::size_t kStart = 6000, kEnd = 1000;
  if (text.size() <= 2 * (kStart + kEnd)) return std::string(text);
  const auto is_inside = [&](std::size_t i) { return (byte_at(text, i) & 0xC0) == 0x80; };
  std::size_t start = kStart, end = text.size() - kEnd;
  while (start > 0 && is_inside(start)) --start;  // no character is cut in two
  while (end < text.size() && is_inside(end)) ++end;
  return fmt::format("{} … ({} bytes left out) … {}", text.substr(0, start), end - start,
                     text.substr(end));
}

}  // namespace vantage
