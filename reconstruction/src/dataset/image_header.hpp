#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace vantage::reconstruction::detail {

struct ImageSize {
  int width = 0;
  int height = 0;
  bool operator==(const ImageSize&) const = default;
};

/// What is known of a colour image before it is decoded.
struct ColorHeader {
  ImageSize size;
  int exif_orientation = 1;  ///< 1 to 8; 1: shown as it is stored
};

/// Reads the header of a PNG, JPEG, TIFF, BMP or WebP image, without decoding it: decoders trust
/// headers, and a file of 2 MB may claim 2 GB. `path` is for the messages.
/// @throws Error bad_input if the bytes are none of these, end before a PNG or JPEG does, have more
/// than 16 bits per channel or floating point, or claim more than 16384 pixels along a side.
ColorHeader check_color_header(std::span<const std::uint8_t> bytes,
                               const std::filesystem::path& path);

/// A warning where EXIF data ask for a rotated image; else empty.
std::string orientation_warning(const ColorHeader& header, const std::filesystem::path& path);

}  // namespace vantage::reconstruction::detail
