#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace vantage::reconstruction::detail {

/// What OpenCV decodes and encodes. Its codecs stand on more than a hundred libraries, so they are
/// a library of their own, which is loaded when the first picture is.
struct ImageCodec {
  /// All channels and bits as they are stored, not turned; empty if it cannot.
  cv::Mat (*decode_unchanged)(const std::uint8_t* bytes, std::size_t size);
  /// The same as blue, green and red of 8 or 16 bits.
  cv::Mat (*decode_color)(const std::uint8_t* bytes, std::size_t size);
  /// A file's bytes; `ending`, as ".jpg", says which kind, `options` are cv::ImwriteFlags.
  std::vector<std::uint8_t> (*encode)(const char* ending, const cv::Mat& image,
                                      const std::vector<int>& options);
};

/// What the library shows, and its name there: libraries of vantage show nothing outside namespace
/// vantage.
__attribute__((visibility("default"))) const ImageCodec* image_codec_table();
inline constexpr const char* kImageCodecSymbol =
    "_ZN7vantage14reconstruction6detail17image_codec_tableEv";

}  // namespace vantage::reconstruction::detail
