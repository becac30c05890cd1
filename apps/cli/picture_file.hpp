#pragma once

#include <filesystem>

#include "vantage/raycore/image.hpp"

namespace vantage {

/// Writes a picture as its file's ending says: .png, or .jpg (.jpeg) in high quality. The same
/// picture gives the same bytes.
/// @throws Error bad_input for another ending, and as `write_file` does.
void write_picture(const std::filesystem::path& path, const ColorImage& image);

}  // namespace vantage
