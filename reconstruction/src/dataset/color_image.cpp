#include "vantage/reconstruction/color_image.hpp"

#include <opencv2/imgcodecs.hpp>
#include <span>
#include <vector>

#include "dataset/image_header.hpp"
#include "images/load_codec.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

/// Full scale stays full scale.
std::uint8_t to_8_bits(std::uint16_t value) {
  return std::uint8_t((value + 128) / 257);
}

/// OpenCV's blue, green, red to red, green, blue.
template <class Sample, class Convert>
ColorImage rgb_of(const cv::Mat& bgr, const Convert& convert) {
  ColorImage image(bgr.cols, bgr.rows);
  for (int v = 0; v < bgr.rows; ++v) {
    const Sample* from = bgr.ptr<Sample>(v);
    std::uint8_t* to = image.pixel(0, v);
    for (int u = 0; u < bgr.cols; ++u, from += 3, to += 3) {
      to[0] = convert(from[2]), to[1] = convert(from[1]), to[2] = convert(from[0]);
    }
  }
  return image;
}

}  // namespace

ColorImage read_color(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  const auto size = reconstruction::detail::check_color_header(bytes, path).size;
  const cv::Mat bgr =
      reconstruction::detail::image_codec().decode_color(bytes.data(), bytes.size());
  const bool fits = bgr.cols == size.width && bgr.rows == size.height;
  if (fits && bgr.type() == CV_8UC3) {
    return rgb_of<std::uint8_t>(bgr, [](std::uint8_t value) { return value; });
  }
  if (fits && bgr.type() == CV_16UC3) return rgb_of<std::uint16_t>(bgr, to_8_bits);
  throw bad_input(path.string(), "corrupt: the image cannot be decoded; copy or record it again");
}

std::string jpeg_bytes(const ColorImage& image) {
  constexpr int kQuality = 85;
  cv::Mat bgr(image.height, image.width, CV_8UC3);
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const std::uint8_t* p = image.pixel(u, v);
      bgr.at<cv::Vec3b>(v, u) = {p[2], p[1], p[0]};
    }
  }
  const auto bytes = reconstruction::detail::image_codec().encode(
      ".jpg", bgr, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  return {bytes.begin(), bytes.end()};
}

}  // namespace vantage
