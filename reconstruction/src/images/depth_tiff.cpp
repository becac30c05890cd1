#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "images/depth_decoders.hpp"
#include "images/load_codec.hpp"
#include "images/raster_headers.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

template <class Sample, class Result, class Convert>
Image<Result, 1> image_of(const cv::Mat& pixels, const Convert& convert) {
  Image<Result, 1> image(pixels.cols, pixels.rows);
  for (int v = 0; v < pixels.rows; ++v) {
    std::transform(pixels.ptr<Sample>(v), pixels.ptr<Sample>(v) + pixels.cols, image.pixel(0, v),
                   convert);
  }
  return image;
}

}  // namespace

RawDepth decode_depth_tiff(std::span<const std::uint8_t> bytes, const std::string& where) {
  const auto header = tiff_header(bytes);
  if (!header) throw bad_input(where, "is not a TIFF image, or is damaged");
  check_depth_size(header->width, header->height, bytes.size(), where);
  const bool is_counts = header->bits == 16 && !header->is_float;
  if (!is_counts && header->bits != 32) {
    throw bad_input(where,
                    fmt::format("has {} bits per pixel{}; expected depth of 16 bits as whole "
                                "numbers, or of 32 bits",
                                header->bits, header->is_float ? ", floating point" : ""));
  }
  if (bytes.size() > (std::size_t(1) << 30)) throw bad_input(where, "has more than 1 GiB");
  // OpenCV reads whole numbers of 32 bits only if they are called signed; their bits are the same.
  std::vector<std::uint8_t> relabelled;
  if (header->bits == 32 && header->unsigned_at > 0) {
    relabelled.assign(bytes.begin(), bytes.end());
    for (std::size_t i = 0; i < 2; ++i) relabelled[header->unsigned_at + i] *= 2;
    bytes = relabelled;
  }
  const cv::Mat pixels = image_codec().decode_unchanged(bytes.data(), bytes.size());
  const bool fits = pixels.channels() == 1 && pixels.cols == int(header->width) &&
                    pixels.rows == int(header->height);
  if (fits && is_counts && pixels.depth() == CV_16U) {
    return image_of<std::uint16_t, std::uint16_t>(pixels, [](std::uint16_t x) { return x; });
  }
  if (fits && header->is_float && pixels.depth() == CV_32F) {
    return image_of<float, float>(pixels, [](float x) { return x; });
  }
  // Whole numbers of 32 bits: older OpenCV calls them floating point, and leaves their bits alone.
  if (fits && !is_counts && (pixels.depth() == CV_32F || pixels.depth() == CV_32S)) {
    return image_of<std::uint32_t, float>(pixels, [](std::uint32_t x) { return float(x); });
  }
  throw bad_input(where,
                  "is a damaged TIFF image, or one of several channels; expected depth of "
                  "one; record or copy it again");
}

}  // namespace vantage::reconstruction::detail
