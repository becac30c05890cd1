#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace vantage::reconstruction::detail {

/// What the header of an image says, before anything is decoded.
struct RasterHeader {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int bits = 0;              ///< of a channel
  bool is_float = false;     ///< or whole numbers
  int exif_orientation = 1;  ///< 1 to 8: how EXIF data ask to turn the image; 1 is as it is stored
  /// Of TIFF: where the file says that its numbers have no sign; 0 if it does not say so.
  std::size_t unsigned_at = 0;
};

/// Tags of the first image of a TIFF file, or of EXIF data, which have the same form.
/// @returns nothing if it is not such a block, or is damaged.
std::optional<RasterHeader> tiff_header(std::span<const std::uint8_t> bytes);

/// @returns nothing if it is not a Windows bitmap.
std::optional<RasterHeader> bmp_header(std::span<const std::uint8_t> bytes);

/// @returns nothing if it is not a WebP image.
std::optional<RasterHeader> webp_header(std::span<const std::uint8_t> bytes);

/// The orientation that a block of EXIF data asks for; 1 where it asks for none.
int exif_orientation(std::span<const std::uint8_t> exif);

}  // namespace vantage::reconstruction::detail
