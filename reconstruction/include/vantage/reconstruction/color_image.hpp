#pragma once

#include <filesystem>
#include <string>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/image.hpp"

namespace vantage {

/// Reads a PNG, JPEG, TIFF, BMP or WebP image as RGB, its pixels as they are stored: a camera's
/// intrinsics belong to those, not to an image turned by its EXIF orientation. Grey becomes RGB; 16
/// bits become 8, full scale for full scale; transparency is dropped. The header is checked before
/// anything is decoded.
/// @throws Error bad_input if the file is missing, none of these, truncated, corrupt, of more than
/// 16 bits per channel, or above 16384 pixels along a side.
VANTAGE_API ColorImage read_color(const std::filesystem::path& path);

/// A JPEG file's bytes, in high quality, of an image with pixels. The same image gives the same
/// bytes. Safe in many threads.
VANTAGE_API std::string jpeg_bytes(const ColorImage& image);

}  // namespace vantage
