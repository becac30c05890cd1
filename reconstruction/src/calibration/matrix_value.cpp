#include "calibration/matrix_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vantage::reconstruction::detail {
namespace {

using nlohmann::json;

/// Appends a list of numbers.
void append_numbers(const json& list, const std::string& expected, MatrixValue& matrix) {
  for (const json& number : list) {
    if (!number.is_number() || !std::isfinite(number.get<double>())) {
      throw bad_input(matrix.place, fmt::format("a number in it is {}; expected finite ones: {}",
                                                shown(number), expected));
    }
    matrix.numbers.push_back(number.get<double>());
  }
}

void read_rows(const json& rows, const std::string& expected, MatrixValue& matrix) {
  matrix.rows = rows.size(), matrix.columns = rows[0].size();
  for (const json& row : rows) {
    if (!row.is_array() || row.size() != matrix.columns) {
      throw bad_input(
          matrix.place,
          fmt::format("found {}, whose rows differ in length; expected {}", shown(rows), expected));
    }
    append_numbers(row, expected, matrix);
  }
}

void read_opencv_matrix(const json& value, const std::string& expected, MatrixValue& matrix) {
  const auto count = [&](const char* key) {
    const auto found = value.find(key);
    const bool is_count =
        found != value.end() && found->is_number_integer() && found->get<std::int64_t>() >= 0;
    if (!is_count) {
      throw bad_input(
          matrix.place,
          fmt::format("it is not an OpenCV matrix, with rows, cols and data; expected {}",
                      expected));
    }
    return std::size_t(found->get<std::int64_t>());
  };
  matrix.rows = count("rows"), matrix.columns = count("cols");
  const auto data = value.find("data");
  if (data == value.end() || !(data->is_array() || data->is_number())) {
    throw bad_input(matrix.place,
                    fmt::format("it is not a matrix: its data are missing; expected {}", expected));
  }
  append_numbers(data->is_array() ? *data : json::array({*data}), expected, matrix);
  if (matrix.rows > 1000 || matrix.columns > 1000) throw matrix.error(expected);
  if (matrix.numbers.size() == matrix.rows * matrix.columns) return;
  throw bad_input(matrix.place,
                  fmt::format("it is not a matrix: {} numbers for {} × {}; expected {}",
                              matrix.numbers.size(), matrix.rows, matrix.columns, expected));
}

}  // namespace

Error MatrixValue::error(const std::string& expected) const {
  return bad_input(place,
                   fmt::format("it has {} × {} numbers; expected {}", rows, columns, expected));
}

MatrixValue matrix_at(const Document& document, const std::string& pointer,
                      const std::string& expected) {
  const json& value = document.root.at(json::json_pointer(pointer));
  MatrixValue matrix{.numbers = {}, .place = document.place(pointer)};
  if (value.is_object()) {
    read_opencv_matrix(value, expected, matrix);
  } else if (value.is_array() && !value.empty() && value[0].is_array()) {
    read_rows(value, expected, matrix);
  } else if (value.is_array()) {
    append_numbers(value, expected, matrix);
    matrix.rows = 1, matrix.columns = matrix.numbers.size(), matrix.is_flat = true;
  } else {
    throw bad_input(matrix.place, fmt::format("it is not an OpenCV matrix: found {}; expected {}",
                                              shown(value), expected));
  }
  return matrix;
}

}  // namespace vantage::reconstruction::detail
