#include "vantage/reconstruction/color_image.hpp"

#include <opencv2/imgcodecs.hpp>
#include <span>
#include <vector>

#include "dataset/image_header.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

cv::Mat decode(const std::vector<std::uint8_t>& bytes) {
  try {
    return cv::imdecode(bytes, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    return {};
  }
}

}  // namespace

ColorImage read_color(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  const reconstruction::detail::ImageSize size =
      reconstruction::detail::check_color_header(bytes, path);
  const cv::Mat bgr = decode(bytes);
  if (bgr.type() != CV_8UC3 || bgr.cols != size.width || bgr.rows != size.height) {
    throw bad_input(path.string(), "corrupt: the image cannot be decoded; copy or record it again");
  }
  ColorImage image(size.width, size.height);
  for (int v = 0; v < size.height; ++v) {
    const std::uint8_t* from = bgr.ptr(v);
    std::uint8_t* to = image.pixel(0, v);
    for (int u = 0; u < size.width; ++u, from += 3, to += 3) {
      to[0] = from[2], to[1] = from[1], to[2] = from[0];
    }
  }
  return image;
}

}  // namespace vantage
