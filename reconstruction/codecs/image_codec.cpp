#include "codecs/image_codec.hpp"

#include <opencv2/imgcodecs.hpp>

namespace vantage::reconstruction::detail {
namespace {

cv::Mat decode(const std::uint8_t* bytes, std::size_t size, int flags) {
  try {
    // OpenCV takes no pointer to const, and does not write to it.
    const cv::Mat file(1, int(size), CV_8U, const_cast<std::uint8_t*>(bytes));
    return cv::imdecode(file, flags);
  } catch (const cv::Exception&) {
    return {};
  }
}

std::vector<std::uint8_t> encode(const char* ending, const cv::Mat& image,
                                 const std::vector<int>& options) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(ending, image, bytes, options);
  return bytes;
}

cv::Mat decode_unchanged(const std::uint8_t* bytes, std::size_t size) {
  return decode(bytes, size, cv::IMREAD_UNCHANGED | cv::IMREAD_IGNORE_ORIENTATION);
}

cv::Mat decode_color(const std::uint8_t* bytes, std::size_t size) {
  return decode(bytes, size,
                cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION);
}

constexpr ImageCodec kCodec{decode_unchanged, decode_color, encode};

}  // namespace

const ImageCodec* image_codec_table() {
  return &kCodec;
}

}  // namespace vantage::reconstruction::detail
