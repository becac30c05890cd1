#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "vantage/raycore/error.hpp"

namespace vantage::raycore::detail {

/// A place in a file; it is made into text only when something is wrong there. Owns nothing.
struct FilePlace {
  std::string_view file;
  std::string_view unit;  ///< "line" (counted from 1), or an element's name (counted from 0)
  std::uint64_t number = 0;

  /// "part.obj:12" for a line, "part.ply, vertex 12" for an element.
  std::string text() const {
    const char* separator = unit == "line" ? ":" : ", ";
    const std::string name = unit == "line" ? "" : std::string(unit) + " ";
    return std::string(file) + separator + name + std::to_string(number);
  }

  [[noreturn]] void fail(std::string message) const { throw bad_input(text(), std::move(message)); }
};

}  // namespace vantage::raycore::detail
