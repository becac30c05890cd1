#pragma once

#include <filesystem>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/image.hpp"

namespace vantage {

/// Reads an 8-bit PNG or JPEG as RGB, its pixels as they are stored: a camera's intrinsics belong
/// to those, not to an image turned by its EXIF orientation. Grey becomes RGB; transparency is
/// dropped. The header is checked before anything is decoded.
/// @throws Error bad_input if the file is missing, neither PNG nor JPEG, truncated, corrupt, of
/// more than 8 bits per channel, or above 16384 pixels along a side.
VANTAGE_API ColorImage read_color(const std::filesystem::path& path);

}  // namespace vantage
