#include "vantage/raycore/detail/npy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <string>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

/// Walks through a Python literal; knows no more of Python than such headers have.
class Literal {
 public:
  Literal(std::string_view text, const std::string& where) : text_(text), where_(where) {}

  /// Skips spaces; takes `token` if it is next.
  bool take(std::string_view token) {
    skip_spaces();
    if (text_.substr(at_, token.size()) != token) return false;
    at_ += token.size();
    return true;
  }
  void expect(std::string_view token) {
    if (!take(token)) fail(fmt::format("\"{}\"", token));
  }

  std::string quoted() {
    const char* quote = take("'") ? "'" : "\"";
    if (*quote == '"' && !take("\"")) fail("a quoted text");
    const std::size_t end = text_.find(*quote, at_);
    if (end == std::string_view::npos) fail("a closing quote");
    const std::string content(text_.substr(at_, end - at_));
    at_ = end + 1;
    return content;
  }

  bool truth() {
    if (take("True")) return true;
    if (!take("False")) fail("True or False");
    return false;
  }

  std::vector<std::int64_t> tuple() {
    std::vector<std::int64_t> numbers;
    expect("(");
    while (!take(")")) {
      skip_spaces();
      std::int64_t number = 0;
      const char *begin = text_.data() + at_, *end = text_.data() + text_.size();
      const auto [rest, error] = std::from_chars(begin, end, number);
      if (error != std::errc() || number < 0) fail("a whole number of 0 or more");
      at_ += std::size_t(rest - begin);
      numbers.push_back(number);
      if (take(",")) continue;
      expect(")");
      break;
    }
    return numbers;
  }

  void expect_end() {
    skip_spaces();
    if (at_ != text_.size()) fail("nothing more");
  }

  [[noreturn]] void fail(const std::string& expected) const {
    throw bad_input(
        where_, fmt::format("the array's header reads {} at its character {}; "
                            "expected {}; is the file damaged?",
                            shown(text_.substr(std::min(at_, text_.size()))), at_ + 1, expected));
  }

 private:
  void skip_spaces() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
  }

  static std::string shown(std::string_view rest) {
    constexpr std::size_t kMax = 20;
    std::string text;
    for (const char c : rest.substr(0, kMax)) text += c >= ' ' && c <= '~' ? c : '?';
    return fmt::format("\"{}\"", text);
  }

  std::string_view text_;
  const std::string& where_;
  std::size_t at_ = 0;
};

}  // namespace

NpyHeader parse_npy_header(std::string_view text, const std::string& where) {
  Literal literal(text, where);
  NpyHeader header;
  std::set<std::string> keys;
  literal.expect("{");
  while (!literal.take("}")) {
    const std::string key = literal.quoted();
    literal.expect(":");
    if (key == "descr") {
      header.type = literal.quoted();
    } else if (key == "fortran_order") {
      header.fortran_order = literal.truth();
    } else if (key == "shape") {
      header.shape = literal.tuple();
    } else {
      literal.fail("the keys descr, fortran_order and shape only");
    }
    if (!keys.insert(key).second) literal.fail("every key once");
    if (literal.take(",")) continue;
    literal.expect("}");
    break;
  }
  if (keys.size() != 3) literal.fail("all of the keys descr, fortran_order and shape");
  literal.expect_end();
  return header;
}

namespace {

constexpr std::size_t kLongestHeader = std::size_t(1) << 16;
constexpr std::string_view kMagic("\x93NUMPY", 6);

/// The header's text is [begin, end); the array begins there.
struct HeaderPlace {
  std::size_t begin = 0, end = 0;
};

HeaderPlace header_place(std::span<const std::uint8_t> bytes, const std::string& where) {
  const bool magic =
      bytes.size() >= 10 && std::equal(kMagic.begin(), kMagic.end(), bytes.begin(),
                                       [](char a, std::uint8_t b) { return std::uint8_t(a) == b; });
  if (!magic) {
    throw bad_input(where,
                    "this is not a NumPy array: it does not begin with \\x93NUMPY; expected what "
                    "numpy.save writes");
  }
  const int version = bytes[6];
  if (version < 1 || version > 3) {
    throw bad_input(
        where, fmt::format("NumPy's format {}.{}; expected 1.0, 2.0 or 3.0", version, bytes[7]));
  }
  // Little-endian: two bytes in format 1, four since.
  const std::size_t width = version == 1 ? 2 : 4, begin = 8 + width;
  std::size_t length = 0;
  for (std::size_t i = 0; i < width && 8 + i < bytes.size(); ++i) {
    length |= std::size_t(bytes[8 + i]) << (8 * i);
  }
  if (length > kLongestHeader || begin + length > bytes.size()) {
    throw bad_input(where,
                    fmt::format("its header states a length of {} bytes, and the file has {}; "
                                "expected a complete header of up to {}; is it truncated?",
                                length, bytes.size(), kLongestHeader));
  }
  return {begin, begin + length};
}

}  // namespace

NpyArray parse_npy(std::span<const std::uint8_t> bytes, const std::string& where) {
  const auto [begin, end] = header_place(bytes, where);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()) + begin, end - begin);
  return {parse_npy_header(text, where), bytes.subspan(end)};
}

}  // namespace vantage
