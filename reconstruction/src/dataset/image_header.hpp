#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace vantage::reconstruction::detail {

struct ImageSize {
  int width = 0;
  int height = 0;
  bool operator==(const ImageSize&) const = default;
};

/// The size of an 8-bit PNG or JPEG, without decoding it: decoders trust headers, and a file of 2
/// MB may claim 2 GB. `path` is for the messages.
/// @throws Error bad_input if the bytes are neither, end before the image does, have more than 8
/// bits per channel, or claim more than 16384 pixels along a side.
ImageSize check_color_header(std::span<const std::uint8_t> bytes,
                             const std::filesystem::path& path);

}  // namespace vantage::reconstruction::detail
