#include "workcell/npy_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>

#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/detail/npy.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr std::int64_t kMaxElements = std::int64_t(1) << 30;
constexpr std::size_t kLongestHeader = std::size_t(1) << 16;

void check_header(const NpyHeader& header, const std::string& where) {
  if (header.type != "|b1" && header.type != "|u1") {
    throw bad_input(where, fmt::format("its elements are \"{}\"; expected \"|b1\" (bool) or "
                                       "\"|u1\" (uint8): convert it with array.astype(bool)",
                                       header.type));
  }
  if (header.fortran_order) {
    throw bad_input(
        where,
        "it is in Fortran order; expected C order: convert it with numpy.ascontiguousarray(array)");
  }
  const bool fits = header.shape.size() == 3 &&
                    std::ranges::all_of(header.shape, [](std::int64_t n) { return n >= 1; });
  if (!fits) {
    throw bad_input(where, fmt::format("its shape is ({}); expected three sizes of 1 or more",
                                       fmt::join(header.shape, ", ")));
  }
  double elements = 1;
  for (const std::int64_t n : header.shape) elements *= double(n);
  if (elements <= double(kMaxElements)) return;
  throw Error(ErrorCode::out_of_resources, where,
              fmt::format("its shape ({}) has {:.3g} elements; at most {} are handled: use larger "
                          "cells",
                          fmt::join(header.shape, ", "), elements, kMaxElements));
}

}  // namespace

ByteArray3 read_npy_bytes(const std::filesystem::path& file) {
  const std::string where = file.string();
  std::vector<std::uint8_t> bytes = read_file(file, std::size_t(kMaxElements) + kLongestHeader);
  const NpyArray array = parse_npy(bytes, where);
  const NpyHeader& header = array.header;
  const std::size_t end = bytes.size() - array.data.size();
  check_header(header, where);
  const std::int64_t elements = header.shape[0] * header.shape[1] * header.shape[2];
  if (bytes.size() - end != std::size_t(elements)) {
    throw bad_input(where,
                    fmt::format("{} bytes follow its header; expected {}, for the shape "
                                "({}); is it truncated?",
                                bytes.size() - end, elements, fmt::join(header.shape, ", ")));
  }
  bytes.erase(bytes.begin(), bytes.begin() + std::ptrdiff_t(end));
  const auto odd = std::find_if(bytes.begin(), bytes.end(), [](std::uint8_t b) { return b > 1; });
  if (header.type == "|b1" && odd != bytes.end()) {
    throw bad_input(where, fmt::format("element {} is {}; expected 0 or 1 in an array of bool",
                                       odd - bytes.begin(), int(*odd)));
  }
  return {{int(header.shape[0]), int(header.shape[1]), int(header.shape[2])}, std::move(bytes)};
}

}  // namespace vantage
