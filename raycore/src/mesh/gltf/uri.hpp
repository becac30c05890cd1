#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vantage::raycore::detail {

/// "a%20b" is "a b" (RFC 3986). What is no such code stays.
inline std::string without_percent(std::string_view text) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool code =
        text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 && digit(text[i + 2]) >= 0;
    result += code ? char(16 * digit(text[i + 1]) + digit(text[i + 2])) : text[i];
    i += code ? 2 : 0;
  }
  return result;
}

/// The bytes of "data:…;base64,…" (RFC 2397, RFC 4648); nothing if it is none.
inline std::optional<std::vector<std::uint8_t>> data_of_uri(std::string_view uri) {
  constexpr std::string_view kMark = ";base64,";
  // Before the mark is the media type, which is short.
  const std::size_t mark = uri.substr(0, 256).find(kMark);
  if (mark == std::string_view::npos) return std::nullopt;
  std::string_view text = uri.substr(mark + kMark.size());
  while (text.ends_with('=')) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int count = 0;
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::int8_t, 256> values;
  values.fill(-1);
  for (std::size_t i = 0; i < kDigits.size(); ++i)
    values[std::uint8_t(kDigits[i])] = std::int8_t(i);
  for (const char c : text) {
    const std::int8_t value = values[std::uint8_t(c)];
    if (value < 0) return std::nullopt;
    bits = (bits << 6 | std::uint32_t(value)) & 0xFFFFFF;
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes.push_back(std::uint8_t(bits >> count));
    }
  }
  return bytes;
}

}  // namespace vantage::raycore::detail
