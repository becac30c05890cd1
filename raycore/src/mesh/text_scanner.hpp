#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/file_place.hpp"

namespace vantage::raycore::detail {

/// `word` in quotes for a message: shortened, and without what a terminal would obey.
std::string in_quotes(std::string_view word);

/// The integer that `text` is, the whole of it; nothing if it is none or does not fit.
std::optional<std::int64_t> to_integer(std::string_view text);

/// Takes a text apart into lines and words and knows which line it is at. Does not own the text.
/// A line ends with LF, CR LF or CR. One that ends with a backslash goes on in the next one, as in
/// OBJ.
class TextScanner {
 public:
  TextScanner(std::string_view text, std::string_view file) : text_(text), file_(file) {}

  /// The next word of this line; empty at the line's end.
  std::string_view word();

  /// The next word, in this line or a later one; empty at the text's end.
  std::string_view word_anywhere();

  /// The next word of this line as a number.
  /// @throws Error bad_input at this line if it is not a number; NaN and infinity are let through.
  double number(std::string_view what);

  /// Goes to the start of the next line. False at the text's end.
  bool next_line();

  /// The index of the next character.
  std::size_t position() const { return position_; }
  FilePlace place() const { return {file_, "line", line_}; }
  [[noreturn]] void fail(std::string message) const { place().fail(std::move(message)); }

 private:
  std::size_t continuation_size() const;
  bool at_blank() const;
  bool at_line_end() const;

  std::string_view text_;
  std::string_view file_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
};

}  // namespace vantage::raycore::detail
