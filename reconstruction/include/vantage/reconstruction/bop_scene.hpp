#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/depth_image.hpp"
#include "vantage/raycore/export.hpp"

namespace vantage {

/// One image of a BOP scene, and with it one camera.
struct BopImage {
  int id = 0;
  std::string place;  ///< of the image's entry, for messages
  Intrinsics intrinsics;
  DepthRange range;
  std::optional<Pose> T_world_cam;          ///< none: to be found by the markers that it sees
  std::shared_ptr<const DepthImage> depth;  ///< null for a scene without a depth folder
  std::filesystem::path color;              ///< for `read_color`; empty if there is none

  /// @throws Error bad_input, with `place`, for an image without a pose.
  VANTAGE_API PinholeCamera camera() const;
};

/// A recording in the format of the BOP benchmark (https://github.com/thodan/bop_toolkit).
struct BopScene {
  std::filesystem::path folder;
  std::vector<BopImage> images;              ///< ascending by id, never empty
  std::vector<std::filesystem::path> files;  ///< every file that was read
  std::vector<std::string> warnings = {};    ///< for people; each names the file that it is about
};

/// Reads `scene_camera.json` and the images of the folder depth; of those in rgb, or else gray,
/// only the size. A file's name is the image's number; depth is PNG, TIFF, EXR or NumPy, colour
/// PNG, JPEG, TIFF, BMP or WebP.
///
/// `cam_K` is row-major in pixels; the pose is the inverse of (`cam_R_w2c`, `cam_t_w2c` in mm), or
/// both are missing; a raw depth times `depth_scale` is in mm. The image's size is that of its
/// depth, else of its colour, else the entry's `width` and `height`; whatever of these is there has
/// to agree.
///
/// A scene of several sensors has a file and folders for each, such as `scene_camera_cam1.json`,
/// depth_cam1 and rgb_cam1; each image of each sensor is a camera. Ids of the first sensor, in the
/// order of their names, are those of the images; those of the next one are 1,000,000 higher, and
/// so on.
/// @param range of every camera: BOP does not store it.
/// @param only_ids loads no other image; empty means all.
/// @throws Error bad_input with the file, the image's id and the key: for files that are missing or
/// damaged, keys that are missing or of the wrong type or length, half a camera pose, a matrix
/// that is no rotation, intrinsics that do not fit the image, an id that is there twice or not at
/// all.
VANTAGE_API BopScene load_bop_scene(const std::filesystem::path& folder,
                                    const DepthRange& range = {},
                                    std::span<const int> only_ids = {});

/// Whether the folder has a `scene_camera.json`, or one of a sensor.
VANTAGE_API bool is_bop_scene(const std::filesystem::path& folder);

/// Photographs by one camera from several places: the PNG, JPEG, TIFF, BMP and WebP files of a
/// folder in the order of their names, with ids from 0; no poses, no depth.
/// @param intrinsics of all of them.
/// @throws Error bad_input for a folder without pictures, damaged ones, and those of another size.
VANTAGE_API BopScene load_photographs(const std::filesystem::path& folder,
                                      const Intrinsics& intrinsics, const DepthRange& range = {});

}  // namespace vantage
