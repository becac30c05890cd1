#pragma once

#include <filesystem>
#include <vector>

#include "vantage/raycore/lens.hpp"
#include "vantage/reconstruction/bop_scene.hpp"

namespace vantage {

/// The lens of each image. Without calibrations those of the scene, without distortion.
/// @param calibrations one for all images, one for each in the order of their ids, or for each
/// "ID=FILE"; a file may be followed by "#CAMERA".
/// @throws Error bad_input as `read_calibration` does, and for calibrations that cannot be assigned
/// to images: a number of them that is neither 1 nor that of the images, ids in front of some only,
/// an id twice or of no image, an image that is left out.
std::vector<Lens> lenses_of(const BopScene& scene,
                            const std::vector<std::filesystem::path>& calibrations);

/// The files themselves, each once.
std::vector<std::filesystem::path> calibration_files(
    const std::vector<std::filesystem::path>& calibrations);

}  // namespace vantage
