#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vantage/raycore/lens.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

/// One image of a recording in another format, and with it one camera.
struct ImportedImage {
  std::string name;            ///< as the source calls it, for messages
  Intrinsics intrinsics = {};  ///< width and height 0: as the image has them
  Distortion distortion = {};  ///< of what the image shows
  std::optional<Pose> T_world_cam = {};
  std::filesystem::path color = {}, depth = {};  ///< empty for none
};

/// A recording as it was found.
struct ImportedDataset {
  std::string format;         ///< e.g. "TUM RGB-D"
  double depth_scale_mm = 1;  ///< millimetres of one count of the depth images
  std::vector<ImportedImage> images = {};
  std::vector<std::filesystem::path> files = {};  ///< that were read for it, except the images
  std::vector<std::string> warnings = {};         ///< for people
};

/// Pixel centres at halves, as COLMAP and nerfstudio have them, to our whole numbers.
inline Intrinsics from_half_pixels(Intrinsics k) {
  k.cx -= 0.5, k.cy -= 0.5;
  return k;
}

// The readers of one format each. `detect_…` says whether the folder looks like it; `read_…` throws
// Error bad_input with file and line, or file and key, for what is not as the format has it.

/// rgb.txt, depth.txt and groundtruth.txt. The format has no intrinsics: `intrinsics` has to give
/// them, unless the folder's name says which of TUM's three cameras it was.
bool detect_tum(const std::filesystem::path& source);
ImportedDataset read_tum(const std::filesystem::path& source, const std::optional<Lens>& lens);

/// transforms.json of nerfstudio, instant-ngp and the NeRF data sets: OpenGL's camera axes.
bool detect_nerfstudio(const std::filesystem::path& source);
ImportedDataset read_nerfstudio(const std::filesystem::path& source);

/// cameras.txt and images.txt, in the folder, or in sparse/ or sparse/0/; pictures in images/,
/// depth in a folder depth/, depths/ or depth_maps/ under the pictures' names.
bool detect_colmap(const std::filesystem::path& source);
ImportedDataset read_colmap(const std::filesystem::path& source);

/// pose/*.txt (camera to world), intrinsic/*.txt, color/ and depth/, as ScanNet's exporter writes.
bool detect_scannet(const std::filesystem::path& source);
ImportedDataset read_scannet(const std::filesystem::path& source);

}  // namespace vantage
