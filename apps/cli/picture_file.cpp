#include "cli/picture_file.hpp"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/image_io.hpp"

namespace vantage {
namespace {

constexpr int kJpegQuality = 85;

}  // namespace

std::string jpeg_bytes(const ColorImage& image) {
  cv::Mat bgr(image.height, image.width, CV_8UC3);
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      const std::uint8_t* p = image.pixel(u, v);
      bgr.at<cv::Vec3b>(v, u) = {p[2], p[1], p[0]};
    }
  }
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  return {bytes.begin(), bytes.end()};
}

void write_picture(const std::filesystem::path& path, const ColorImage& image) {
  const std::string ending = path.extension().string();
  if (ending == ".png") {
    write_png(path, image);
  } else if (ending == ".jpg" || ending == ".jpeg") {
    write_file(path, jpeg_bytes(image));
  } else {
    throw bad_input(path.string(),
                    fmt::format("found the ending \"{}\"; expected .png or .jpg", ending));
  }
}

}  // namespace vantage
