#include "mesh/text_scanner.hpp"

#include <fmt/format.h>

#include <charconv>
#include <system_error>

namespace vantage::raycore::detail {

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text = "\"";
  for (const char c : word.substr(0, kLongest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > kLongest ? "…\"" : "\"");
}

std::optional<std::int64_t> to_integer(std::string_view text) {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end) return std::nullopt;
  return value;
}

std::string_view TextScanner::word() {
  while (position_ < text_.size()) {
    if (const std::size_t size = continuation_size(); size > 0) {
      position_ += size;
      ++line_;
    } else if (at_blank()) {
      ++position_;
    } else {
      break;
    }
  }
  const std::size_t start = position_;
  while (position_ < text_.size() && !at_line_end() && !at_blank() && continuation_size() == 0) {
    ++position_;
  }
  return text_.substr(start, position_ - start);
}

std::string_view TextScanner::word_anywhere() {
  while (true) {
    const std::string_view found = word();
    if (!found.empty() || !next_line()) return found;
  }
}

double TextScanner::number(std::string_view what) {
  const std::string_view found = word();
  if (found.empty()) fail(fmt::format("ends before {}; expected a number there", what));
  // from_chars knows no plus sign.
  const std::string_view digits = found.front() == '+' ? found.substr(1) : found;
  double value = 0;
  const char* end = digits.data() + digits.size();
  const auto [rest, error] = std::from_chars(digits.data(), end, value);
  if (error != std::errc() || rest != end) {
    fail(fmt::format("{} is {}; expected a number", what, in_quotes(found)));
  }
  return value;
}

bool TextScanner::next_line() {
  for (; position_ < text_.size(); ++position_) {
    if (!at_line_end()) continue;
    ++position_;
    ++line_;
    return true;
  }
  return false;
}

/// The size of a backslash and the line's end behind it; 0 if there is none here.
std::size_t TextScanner::continuation_size() const {
  if (text_[position_] != '\\') return 0;
  const std::string_view rest = text_.substr(position_ + 1, 2);
  if (rest == "\r\n") return 3;
  return rest.starts_with('\n') || rest.starts_with('\r') ? 2 : 0;
}

bool TextScanner::at_blank() const {
  const char c = text_[position_];
  return c == ' ' || c == '\t' || c == '\v' || c == '\f' || (c == '\r' && !at_line_end());
}

bool TextScanner::at_line_end() const {
  const char c = text_[position_];
  if (c != '\r') return c == '\n';
  return position_ + 1 == text_.size() || text_[position_ + 1] != '\n';
}

}  // namespace vantage::raycore::detail
