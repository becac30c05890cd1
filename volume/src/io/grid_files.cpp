#include "vantage/volume/grid_files.hpp"

#include <fmt/format.h>
#include "grid/openvdb.hpp"

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "grid/mask_blocks.hpp"
#include "grid/state_grid_impl.hpp"
#include "grid/write_stream.hpp"

namespace vantage {
namespace {

static_assert(std::endian::native == std::endian::little, "the arrays are written as they lie");

/// NumPy's format 1.0: magic, version, length of the header, and a Python literal that is padded so
/// that the array begins at a multiple of 64 bytes.
std::string npy_header(const char* type, const Eigen::Vector3i& size) {
  std::string literal =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}, {}), }}", type,
                  size.x(), size.y(), size.z());
  constexpr std::size_t kBefore = 10, kAlignment = 64;
  const std::size_t unpadded = kBefore + literal.size() + 1;
  literal.append((kAlignment - unpadded % kAlignment) % kAlignment, ' ');
  literal += '\n';
  std::string header("\x93NUMPY\x01\x00", 8);
  header += char(literal.size() & 0xff);
  header += char(literal.size() >> 8);
  return header + literal;
}

/// Writes an array whose rows along z `fill(i, j, row)` makes.
template <class T, class Fill>
void write_npy(const std::filesystem::path& path, const char* type, const Eigen::Vector3i& size,
               const Fill& fill) {
  volume::detail::write_stream(path, [&](std::ostream& file) {
    const std::string header = npy_header(type, size);
    file.write(header.data(), std::streamsize(header.size()));
    std::vector<T> row(std::size_t(size.z()));
    for (int i = 0; i < size.x() && file; ++i) {
      for (int j = 0; j < size.y() && file; ++j) {
        fill(i, j, row.data());
        file.write(reinterpret_cast<const char*>(row.data()),
                   std::streamsize(row.size() * sizeof(T)));
      }
    }
  });
}

/// Fills rows with states, eight voxels at a time.
class StateRows {
 public:
  explicit StateRows(const StateGrid& grid)
      : length_(grid.geometry().size().z()),
        occupied_(grid.impl().occupied),
        shadow_(grid.impl().shadow),
        revealed_(grid.impl().revealed) {}

  void operator()(int i, int j, std::uint8_t* row) {
    for (int k = 0; k < length_; k += 8) {
      const openvdb::Coord first(i, j, k);
      const unsigned occupied = occupied_.row(first), shadow = shadow_.row(first);
      const unsigned revealed = revealed_.row(first);
      for (int bit = 0; bit < std::min(8, length_ - k); ++bit) {  // 1, 2 and 3
        row[k + bit] = std::uint8_t((occupied >> bit & 1) + (shadow >> bit & 1) * 2 +
                                    (revealed >> bit & 1) * 3);
      }
    }
  }

 private:
  int length_;
  volume::detail::BlockReader occupied_, shadow_, revealed_;
};

}  // namespace

void write_labels_npy(const std::filesystem::path& path, const StateGrid& grid) {
  StateRows rows(grid);
  write_npy<std::uint8_t>(path, "|u1", grid.geometry().size(),
                          [&](int i, int j, std::uint8_t* row) { rows(i, j, row); });
}

void write_regions_npy(const std::filesystem::path& path, const ShadowRegions& regions) {
  write_npy<std::int32_t>(
      path, "<i4", regions.geometry().size(),
      [&](int i, int j, std::int32_t* row) { regions.labels_of_row(i, j, row); });
}

}  // namespace vantage
