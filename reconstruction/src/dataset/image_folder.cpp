#include <fmt/format.h>

#include <algorithm>

#include "dataset/image_header.hpp"
#include "images/numbered_images.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/reconstruction/bop_scene.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> pictures_in(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw bad_input(folder.string(), "no such folder");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && reconstruction::detail::is_color_image(entry.path()))
      files.push_back(entry.path());
  }
  if (files.empty()) {
    throw bad_input(folder.string(),
                    "neither scene_camera.json nor pictures; expected a BOP scene folder, or one "
                    "with photographs (PNG, JPEG, TIFF, BMP, WebP) by one calibrated camera");
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

BopScene load_photographs(const fs::path& folder, const Intrinsics& intrinsics,
                          const DepthRange& range) {
  intrinsics.check("intrinsics");
  range.check("depth range");
  BopScene scene{folder, {}, {}};
  for (const fs::path& file : pictures_in(folder)) {
    const auto header = reconstruction::detail::check_color_header(read_file(file), file);
    const auto& size = header.size;
    const std::string warning = reconstruction::detail::orientation_warning(header, file);
    if (!warning.empty()) scene.warnings.push_back(warning);
    if (size.width != intrinsics.width || size.height != intrinsics.height) {
      throw bad_input(file.string(),
                      fmt::format("{} x {} pixels, but the camera's calibration is for {} x {}; "
                                  "photographs have to be as the camera took them",
                                  size.width, size.height, intrinsics.width, intrinsics.height));
    }
    const int id = int(scene.images.size());
    scene.images.push_back({id, file.string(), intrinsics, range, {}, nullptr, file});
    scene.files.push_back(file);
  }
  return scene;
}

}  // namespace vantage
