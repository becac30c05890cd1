#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace vantage {

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
