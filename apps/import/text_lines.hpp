#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vantage {

/// A line of a text file, as its words between spaces.
class TextLine {
 public:
  TextLine(std::string place, std::vector<std::string> words)
      : place_(std::move(place)), words_(std::move(words)) {}

  const std::string& place() const { return place_; }  ///< "file:line"
  std::size_t size() const { return words_.size(); }
  bool empty() const { return words_.empty(); }

  /// @throws Error bad_input for a line that has fewer words. `what` says what was looked for.
  const std::string& word(std::size_t index, const char* what) const;
  /// A number, infinity and NaN included. @throws Error bad_input for another word.
  double number(std::size_t index, const char* what) const;
  /// @throws Error bad_input for anything but a whole number from 0.
  int whole(std::size_t index, const char* what) const;
  /// All words from `first` as one, with single spaces: a file's name may have some.
  std::string rest(std::size_t first, const char* what) const;

 private:
  std::string place_;
  std::vector<std::string> words_;
};

/// The lines of a file but for comments, which begin with #. Empty lines stay.
/// @throws Error bad_input as `read_file` does, for more than 256 MiB, and for a file that is not
/// text.
std::vector<TextLine> read_text_lines(const std::filesystem::path& file);

}  // namespace vantage
