#include "import/dataset_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <iterator>
#include <set>
#include <span>
#include <string_view>

#include "cli/pose_json.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/reconstruction/bop_scene.hpp"
#include "vantage/reconstruction/calibration.hpp"
#include "version.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kImportRecord = "import.json";
constexpr const char* kUnfinishedFolder = ".unfinished_import";

/// What an import writes, while it is being written: it lies in a folder of its own within the
/// dataset's until all is there. Half a dataset looks like a whole one, and an import that fails
/// must not take the earlier one with it.
class UnfinishedDataset {
 public:
  explicit UnfinishedDataset(const fs::path& folder);
  ~UnfinishedDataset();
  UnfinishedDataset(const UnfinishedDataset&) = delete;
  UnfinishedDataset& operator=(const UnfinishedDataset&) = delete;

  const fs::path& parts() const { return parts_; }

  /// Puts what was written in the place of an earlier import's.
  void finish();

 private:
  void refuse_foreign() const;
  void remove_earlier_import() const;

  fs::path folder_, parts_;
  bool was_there_;
};

/// Refuses to mix a dataset with other files.
void UnfinishedDataset::refuse_foreign() const {
  if (fs::exists(folder_) && !fs::is_directory(folder_)) {
    throw bad_input(folder_.string(), "a file has this name; name a folder for the dataset");
  }
  if (!was_there_ || fs::is_regular_file(folder_ / kImportRecord)) return;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (entry.path() == parts_) continue;  // of an import that was killed
    throw bad_input(folder_.string(),
                    "the folder is not empty, and its files were not written by an import; name "
                    "another one, so that nothing is lost");
  }
}

void UnfinishedDataset::remove_earlier_import() const {
  for (const char* name : {"rgb", "depth", "scene_camera.json", kImportRecord}) {
    fs::remove_all(folder_ / name);
  }
  std::vector<fs::path> calibrations;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("calibration") && name.ends_with(".yml")) {
      calibrations.push_back(entry.path());
    }
  }
  for (const fs::path& file : calibrations) fs::remove(file);
}

UnfinishedDataset::UnfinishedDataset(const fs::path& folder)
    : folder_(folder), parts_(folder / kUnfinishedFolder), was_there_(fs::exists(folder)) {
  refuse_foreign();
  fs::remove_all(parts_);
  for (const char* name : {"rgb", "depth"}) fs::create_directories(parts_ / name);
}

void UnfinishedDataset::finish() {
  remove_earlier_import();
  std::vector<fs::path> written;
  for (const auto& entry : fs::directory_iterator(parts_)) written.push_back(entry.path());
  // The record comes last: a folder that has it is whole.
  std::partition(written.begin(), written.end(),
                 [](const fs::path& part) { return part.filename() != kImportRecord; });
  for (const fs::path& part : written) fs::rename(part, folder_ / part.filename());
  fs::remove(parts_);
  was_there_ = true;
}

UnfinishedDataset::~UnfinishedDataset() {
  std::error_code ignored;
  fs::remove_all(parts_, ignored);
  if (!was_there_) fs::remove(folder_, ignored);
}

std::vector<int> chosen(const ImportedDataset& dataset, const ImportChoice& choice) {
  const int count = int(dataset.images.size());
  std::vector<int> ids;
  for (const int id : choice.images) {
    if (id >= 0 && id < count) continue;
    throw bad_input("--images",
                    fmt::format("there is no image {}; there are {}, numbered from 0 to {}", id,
                                count, count - 1));
  }
  for (int id = 0; id < count; ++id) {
    const bool asked =
        choice.images.empty() || std::ranges::find(choice.images, id) != choice.images.end();
    if (asked && id % choice.every == 0) ids.push_back(id);
  }
  if (ids.empty()) {
    throw bad_input("SOURCE",
                    "no image is left; choose others with --images and --every, or see the "
                    "warnings for why images were left out");
  }
  return ids;
}

/// Whatever else a recording names, be it a file of passwords, is not copied, and would not be
/// read.
void check_ending(const fs::path& file, const ImportedImage& image) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return char(std::tolower(c)); });
  constexpr std::array kEndings = {".png", ".jpg",  ".jpeg", ".tif", ".tiff",
                                   ".bmp", ".webp", ".exr",  ".npy"};
  if (std::ranges::find(kEndings, ending) != kEndings.end()) return;
  throw bad_input(file.string(), fmt::format("image {} names it, and by its ending it is none; "
                                             "expected one of {}",
                                             image.name, fmt::join(kEndings, ", ")));
}

void check_pose(const ImportedImage& image) {
  constexpr double kFarthest_m = 1e6;
  if (!image.T_world_cam) return;
  const Eigen::Vector3d& at = image.T_world_cam->translation();
  if (at.cwiseAbs().maxCoeff() <= kFarthest_m) return;
  throw bad_input(image.name, fmt::format("its camera is at ({:g}, {:g}, {:g}) m; expected "
                                          "coordinates of at most {:g}",
                                          at.x(), at.y(), at.z(), kFarthest_m));
}

/// Copies a file as rgb/000012.jpg or the like.
void copy_image(const fs::path& from, const ImportedImage& image, const fs::path& folder, int id) {
  check_ending(from, image);
  if (!fs::is_regular_file(from)) {
    throw bad_input(from.string(), fmt::format("missing: image {} needs it", image.name));
  }
  const fs::path to = folder / fmt::format("{:06d}{}", id, from.extension().string());
  const std::vector<std::uint8_t> bytes = read_file(from);
  write_file(to, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Json entry_of(const ImportedImage& image, double depth_scale_mm) {
  const Intrinsics& k = image.intrinsics;
  Json entry{{"cam_K", {k.fx, 0.0, k.cx, 0.0, k.fy, k.cy, 0.0, 0.0, 1.0}},
             {"depth_scale", depth_scale_mm}};
  if (image.T_world_cam) {
    const Pose T_cam_world = image.T_world_cam->inverse();
    entry["cam_R_w2c"] = bop_rotation(T_cam_world);
    entry["cam_t_w2c"] = bop_translation(T_cam_world);
  }
  return entry;
}

/// Writes to `parts` one file where all lenses are alike, else one for each image. @returns the
/// option to give once they are in `folder`.
std::string write_lenses(const ImportedDataset& dataset, const std::vector<int>& ids,
                         const BopScene& scene, const fs::path& parts, const fs::path& folder) {
  const auto& first = dataset.images[std::size_t(ids.front())];
  bool distorted = false, alike = true;
  for (const int id : ids) {
    const ImportedImage& image = dataset.images[std::size_t(id)];
    distorted |= !image.distortion.none();
    alike &= image.distortion == first.distortion && image.intrinsics == first.intrinsics;
  }
  if (!distorted) return {};
  std::string option;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::string name =
        alike ? "calibration.yml" : fmt::format("calibration_{:06d}.yml", ids[i]);
    const std::string file = (folder / name).string();
    const Lens lens(scene.images[i].intrinsics, dataset.images[std::size_t(ids[i])].distortion,
                    dataset.images[std::size_t(ids[i])].name);
    write_file(parts / name, calibration_yaml(lens));
    option += alike ? file : fmt::format("{}{}={}", option.empty() ? "" : ",", ids[i], file);
    if (alike) break;
  }
  return option;
}

/// Colour images of another size than the depth images cannot be used: they share one set of
/// intrinsics.
void leave_out_colour(const std::vector<int>& ids, const fs::path& folder,
                      ImportedDataset& dataset) {
  fs::remove_all(folder / "rgb");
  for (const int id : ids) dataset.images[std::size_t(id)].color.clear();
  dataset.warnings.push_back(
      "the pictures are not as large as the depth images and were left out; the intrinsics are "
      "those of the depth images");
}

/// Some images at a time, so that Ctrl-C need not wait for all of a long recording.
BopScene load_in_parts(const std::vector<int>& ids, const fs::path& folder, const StopToken& stop) {
  constexpr std::size_t kPart = 32;
  BopScene scene{folder, {}, {}};
  for (std::size_t begin = 0; begin < ids.size(); begin += kPart) {
    if (stop.stop_requested()) throw Error(ErrorCode::cancelled, "import", "interrupted");
    const std::size_t count = std::min(kPart, ids.size() - begin);
    BopScene part = load_bop_scene(folder, {}, std::span(ids).subspan(begin, count));
    std::ranges::move(part.images, std::back_inserter(scene.images));
    std::ranges::move(part.warnings, std::back_inserter(scene.warnings));
    for (BopImage& image : scene.images) image.depth.reset();  // it was looked at, that is all
  }
  return scene;
}

/// What the dataset's own reader makes of what was written.
BopScene read_back(const std::vector<int>& ids, const fs::path& folder, ImportedDataset& dataset,
                   const StopToken& stop) {
  try {
    return load_in_parts(ids, folder, stop);
  } catch (const Error& error) {
    const bool is_size =
        std::string_view(error.what()).find("of one size") != std::string_view::npos;
    if (!is_size || dataset.format != "ScanNet") throw;
    leave_out_colour(ids, folder, dataset);
    return load_in_parts(ids, folder, stop);
  }
}

}  // namespace

Json write_imported(ImportedDataset& dataset, const ImportChoice& choice, const fs::path& folder,
                    const StopToken& stop) {
  const double depth_scale_mm = choice.depth_scale_mm.value_or(dataset.depth_scale_mm);
  const std::vector<int> ids = chosen(dataset, choice);
  const auto has_depth = [&](int id) { return !dataset.images[std::size_t(id)].depth.empty(); };
  const bool all_depth = std::ranges::all_of(ids, has_depth);
  if (!all_depth && std::ranges::any_of(ids, has_depth)) {
    const int id = *std::ranges::find_if_not(ids, has_depth);
    throw bad_input(dataset.images[std::size_t(id)].name,
                    "has no depth image, but other images do; choose those with --images");
  }
  UnfinishedDataset unfinished(folder);
  const fs::path& parts = unfinished.parts();
  Json cameras = Json::object();
  stop.expect(ids.size());
  for (const int id : ids) {
    if (stop.stop_requested()) throw Error(ErrorCode::cancelled, "import", "interrupted");
    const ImportedImage& image = dataset.images[std::size_t(id)];
    check_pose(image);
    if (!image.color.empty()) copy_image(image.color, image, parts / "rgb", id);
    if (!image.depth.empty()) copy_image(image.depth, image, parts / "depth", id);
    cameras[std::to_string(id)] = entry_of(image, depth_scale_mm);
    const Intrinsics& k = image.intrinsics;
    if (image.color.empty() && image.depth.empty() && k.width > 0) {
      cameras[std::to_string(id)]["width"] = k.width,
      cameras[std::to_string(id)]["height"] = k.height;
    }
    stop.advance(1);
  }
  for (const char* name : {"rgb", "depth"}) {
    if (fs::is_empty(parts / name)) fs::remove(parts / name);
  }
  write_file(parts / "scene_camera.json", cameras.dump(1) + "\n");
  const BopScene scene = read_back(ids, parts, dataset, stop);
  dataset.warnings.insert(dataset.warnings.end(), scene.warnings.begin(), scene.warnings.end());
  Json record{{"vantage", kVersion},
              {"format", dataset.format},
              {"images", ids},
              {"depth", all_depth},
              {"depth_scale_mm", depth_scale_mm},
              {"calibration", write_lenses(dataset, ids, scene, parts, folder)},
              {"warnings", dataset.warnings}};
  write_file(parts / kImportRecord, record.dump(1) + "\n");
  unfinished.finish();
  return record;
}

}  // namespace vantage
