#pragma once

#include <dlfcn.h>
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "codecs/image_codec.hpp"

namespace vantage::test {

/// A picture's file, by the codecs that vantage loads: linking OpenCV's would take a tenth of a
/// second of every test.
inline std::string encoded_image(const char* ending, const cv::Mat& image,
                                 const std::vector<int>& options = {}) {
  static void* library = ::dlopen(VANTAGE_CODECS, RTLD_NOW);
  REQUIRE(library);
  static void* symbol = ::dlsym(library, reconstruction::detail::kImageCodecSymbol);
  REQUIRE(symbol);
  const auto codec = reinterpret_cast<decltype(&reconstruction::detail::image_codec_table)>(symbol);
  const auto bytes = codec()->encode(ending, image, options);
  REQUIRE(!bytes.empty());
  return {bytes.begin(), bytes.end()};
}

}  // namespace vantage::test
