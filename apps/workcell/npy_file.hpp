#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
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

/// A NumPy array of shape (nx, ny, nz) with one byte for each element.
struct ByteArray3 {
  Eigen::Vector3i shape = Eigen::Vector3i::Zero();
  std::vector<std::uint8_t> values = {};  ///< [i, j, k], k fastest
};

/// Reads a .npy file (NumPy's format 1.0, 2.0 or 3.0) with a three-dimensional array of bool or
/// uint8 in C order.
/// @throws Error bad_input with the file for one that is missing, no .npy, of another format, type,
/// order or number of dimensions, without elements, truncated or too long, and for a bool that is
/// neither; out_of_resources for more than 2^30 elements.
ByteArray3 read_npy_bytes(const std::filesystem::path& file);

}  // namespace vantage
