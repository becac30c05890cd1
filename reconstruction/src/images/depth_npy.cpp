#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <cstring>

#include "images/depth_decoders.hpp"
#include "vantage/raycore/detail/npy.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

static_assert(std::endian::native == std::endian::little, "the arrays are taken as they are");

template <class Sample, class Result>
Image<Result, 1> pixels_of(const NpyArray& array, int width, int height, const std::string& where) {
  Image<Result, 1> image(width, height);
  if (array.data.size() != image.samples.size() * sizeof(Sample)) {
    throw bad_input(where, fmt::format("{} bytes follow its header; expected {}, for {} x {} "
                                       "pixels of {} bytes; is it truncated?",
                                       array.data.size(), image.samples.size() * sizeof(Sample),
                                       width, height, sizeof(Sample)));
  }
  for (std::size_t i = 0; i < image.samples.size(); ++i) {
    Sample sample;
    std::memcpy(&sample, array.data.data() + i * sizeof(Sample), sizeof(Sample));
    image.samples[i] = Result(sample);
  }
  return image;
}

}  // namespace

RawDepth decode_depth_npy(std::span<const std::uint8_t> bytes, const std::string& where) {
  const NpyArray array = parse_npy(bytes, where);
  const auto& [type, fortran_order, shape] = array.header;
  const bool is_image = shape.size() == 2 || (shape.size() == 3 && shape[2] == 1);
  if (!is_image || fortran_order) {
    throw bad_input(
        where, fmt::format("its shape is ({}){}; expected (height, width) in C's order",
                           fmt::join(shape, ", "), fortran_order ? ", in Fortran's order" : ""));
  }
  check_depth_size(shape[1], shape[0], bytes.size(), where);
  const int width = int(shape[1]), height = int(shape[0]);
  if (type == "<u2") return pixels_of<std::uint16_t, std::uint16_t>(array, width, height, where);
  if (type == "<f4") return pixels_of<float, float>(array, width, height, where);
  if (type == "<f8") return pixels_of<double, float>(array, width, height, where);
  throw bad_input(where, fmt::format("its elements are \"{}\"; expected \"<u2\" (uint16), \"<f4\" "
                                     "(float32) or \"<f8\" (float64)",
                                     type));
}

}  // namespace vantage::reconstruction::detail
