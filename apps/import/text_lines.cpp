#include "import/text_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string_view>

#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

std::vector<std::string> words_of(std::string_view text) {
  constexpr std::string_view kSpaces = " \t\r,";
  std::vector<std::string> words;
  for (std::size_t at = text.find_first_not_of(kSpaces); at != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kSpaces, at), text.size());
    words.emplace_back(text.substr(at, end - at));
    at = text.find_first_not_of(kSpaces, end);
  }
  return words;
}

}  // namespace

const std::string& TextLine::word(std::size_t index, const char* what) const {
  if (index < words_.size()) return words_[index];
  throw bad_input(
      place_, fmt::format("has {} words; expected {} as word {}", words_.size(), what, index + 1));
}

double TextLine::number(std::size_t index, const char* what) const {
  std::string_view digits = word(index, what);
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc() && end == digits.data() + digits.size()) return value;
  throw bad_input(place_, fmt::format("word {} is \"{}\"; expected {}, a number", index + 1,
                                      words_[index].substr(0, 60), what));
}

int TextLine::whole(std::size_t index, const char* what) const {
  const std::string& digits = word(index, what);
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc() && end == digits.data() + digits.size() && value >= 0) return value;
  throw bad_input(place_, fmt::format("word {} is \"{}\"; expected {}, a whole number", index + 1,
                                      digits.substr(0, 60), what));
}

std::string TextLine::rest(std::size_t first, const char* what) const {
  std::string text = word(first, what);
  for (std::size_t i = first + 1; i < words_.size(); ++i) text += " " + words_[i];
  return text;
}

std::vector<TextLine> read_text_lines(const std::filesystem::path& file) {
  constexpr std::size_t kMaxBytes = std::size_t(256) << 20;
  const std::vector<std::uint8_t> bytes = read_file(file, kMaxBytes);
  std::string_view rest(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (rest.find('\0') != std::string_view::npos) {
    throw bad_input(file.string(), "is not a text file; expected lines of words");
  }
  std::vector<TextLine> lines;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view text = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (text.starts_with('#')) continue;
    lines.emplace_back(fmt::format("{}:{}", file.string(), number), words_of(text));
  }
  return lines;
}

}  // namespace vantage
