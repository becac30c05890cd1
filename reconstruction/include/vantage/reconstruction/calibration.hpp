#pragma once

#include <filesystem>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/lens.hpp"

namespace vantage {

/// Reads what OpenCV's calibration tools write (YAML or XML by cv::FileStorage): `camera_matrix`,
/// `distortion_coefficients` (4, 5 or 8 of them), and `image_width` and `image_height` if they are
/// there.
/// @param width, height of the images that the camera took; 0: as the file says.
/// @throws Error bad_input with the file and the key for what is missing, of the wrong size, not
/// finite, for skew, for a size that differs from the images', for thin-prism or tilted models (12
/// or 14 coefficients) that are not zero beyond the eighth, and as `Lens` does.
VANTAGE_API Lens read_calibration(const std::filesystem::path& file, int width = 0, int height = 0);

}  // namespace vantage
