#pragma once

#include <string>
#include <vector>

#include "documents/document.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {

/// Numbers of a calibration file, row by row, however they are written.
struct MatrixValue {
  std::vector<double> numbers;
  std::size_t rows = 0, columns = 0;
  bool is_flat = false;  ///< one list, which does not say where a row ends: it counts as one
  std::string place;

  /// "it has 2 × 3 numbers; expected …".
  Error error(const std::string& expected) const;
};

/// Reads `{rows, cols, data: […]}` of OpenCV and ROS, a list of numbers, or a list of rows.
/// @param expected for messages.
/// @throws Error bad_input with the value's place for anything else, for rows of different length,
/// for a count that differs from rows times cols, and for a number that is not finite.
MatrixValue matrix_at(const Document& document, const std::string& pointer,
                      const std::string& expected);

}  // namespace vantage::reconstruction::detail
