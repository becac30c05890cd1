#pragma once

#include <filesystem>
#include <functional>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/image.hpp"

namespace vantage {

/// An 8-bit RGB PNG. The same image gives the same bytes.
/// @param effort zlib's level: 1 takes a third of the time that 6 takes, for a larger file.
/// @throws Error as `write_file` does; bad_input for an image without pixels.
VANTAGE_API void write_png(const std::filesystem::path& path, const ColorImage& image,
                           int effort = 6);

/// A 16-bit grey PNG.
VANTAGE_API void write_png(const std::filesystem::path& path, const RawDepthImage& image);

/// Reads a 16-bit grey PNG, as depth is stored.
/// @throws Error bad_input if the file is missing, no PNG, truncated, corrupt, of another bit depth
/// or colour type (8-bit depth is never scaled up), or larger than 16384 pixels along a side, 2^26
/// in all or 256 MiB.
/// @param accept gets the size that the header states, before memory is taken for the pixels; it
/// throws where that is not the size that is expected.
VANTAGE_API RawDepthImage
read_png_counts(const std::filesystem::path& path,
                const std::function<void(int width, int height)>& accept = {});

}  // namespace vantage
