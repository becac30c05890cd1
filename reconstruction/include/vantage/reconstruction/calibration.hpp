#pragma once

#include <filesystem>
#include <string>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/lens.hpp"

namespace vantage {

/// A calibration file, and which of its cameras is meant.
struct CalibrationName {
  std::filesystem::path file;
  std::string camera = {};  ///< empty: the only one
};

/// "camchain.yaml#cam1" is the camera cam1 of camchain.yaml. A file of the whole name comes first.
VANTAGE_API CalibrationName calibration_name(const std::filesystem::path& name);

/// Reads a calibration as YAML, JSON or OpenCV's XML: of OpenCV's tools and samples
/// (`camera_matrix`, `distortion_coefficients`, `fisheye_model`, also called `cameraMatrix`, `K`,
/// `M1`; `distCoeffs`, `D`, `D1`), of ROS (`camera_info`, with `distortion_model`) and of Kalibr
/// (camchain: `intrinsics`, `distortion_coeffs`). Brown–Conrady with 4, 5 or 8 coefficients (the
/// rational model), and fisheye with 4. The image's size is read where it is there.
/// @param name the file, and `#camera` behind it where it has several.
/// @param width, height of the images that the camera took; 0: as the file says.
/// @throws Error bad_input with the file and the key for what is missing, of the wrong size, not
/// finite, for skew, for a size that differs from the images', for other lens models by their name,
/// for thin-prism or tilted models (12 or 14 coefficients) that are not zero beyond the eighth, and
/// as `Lens` does.
VANTAGE_API Lens read_calibration(const std::filesystem::path& name, int width = 0, int height = 0);

/// The text of a calibration file as OpenCV's tools write and read it.
VANTAGE_API std::string calibration_yaml(const Lens& lens);

}  // namespace vantage
