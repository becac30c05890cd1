#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/raycore/export.hpp"

namespace vantage {

/// What a .npy file says of its array: numpy.lib.format describes the file.
struct NpyHeader {
  std::string type;  ///< e.g. "|u1"
  bool fortran_order = false;
  std::vector<std::int64_t> shape;
};

/// Reads the header's text, a Python dictionary with the keys `descr`, `fortran_order` and `shape`.
/// @throws Error bad_input at `where` for anything else.
VANTAGE_API NpyHeader parse_npy_header(std::string_view text, const std::string& where);

/// A .npy file (NumPy's format 1.0, 2.0 or 3.0): its header, and the bytes that follow it.
struct NpyArray {
  NpyHeader header;
  std::span<const std::uint8_t> data;  ///< part of the file's bytes; of any length
};

/// @throws Error bad_input at `where` for what is no such file, or ends within its header.
VANTAGE_API NpyArray parse_npy(std::span<const std::uint8_t> bytes, const std::string& where);

}  // namespace vantage
