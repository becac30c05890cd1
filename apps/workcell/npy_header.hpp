#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vantage {

/// What a .npy file says of its array: numpy.lib.format describes the file.
struct NpyHeader {
  std::string type;  ///< e.g. "|u1"
  bool fortran_order = false;
  std::vector<std::int64_t> shape;
};

/// Reads the header's text, a Python dictionary with the keys `descr`, `fortran_order` and `shape`.
/// @throws Error bad_input at `where` for anything else.
NpyHeader parse_npy_header(std::string_view text, const std::string& where);

}  // namespace vantage
