#include <fmt/format.h>

#include <algorithm>

#include "dataset/image_header.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/reconstruction/bop_scene.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

bool is_picture(const fs::path& file) {
  const std::string ending = file.extension().string();
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg" || ending == ".JPG";
}

std::vector<fs::path> pictures_in(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw bad_input(folder.string(), "no such folder");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_picture(entry.path())) files.push_back(entry.path());
  }
  if (files.empty()) {
    throw bad_input(folder.string(),
                    "neither scene_camera.json nor pictures; expected a BOP scene folder, or one "
                    "with photographs (PNG, JPEG) by one calibrated camera");
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
    const reconstruction::detail::ImageSize size =
        reconstruction::detail::check_color_header(read_file(file), file);
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
