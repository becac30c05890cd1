#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "import/imported_dataset.hpp"
#include "import/text_lines.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/reconstruction/color_image.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

/// Rows of numbers, of which there have to be this many.
template <int kRows, int kColumns>
Eigen::Matrix<double, kRows, kColumns> read_text_matrix(const fs::path& file) {
  Eigen::Matrix<double, kRows, kColumns> m;
  int row = 0;
  for (const TextLine& line : read_text_lines(file)) {
    if (line.empty() || row == kRows) continue;
    for (int j = 0; j < kColumns; ++j) m(row, j) = line.number(std::size_t(j), "a matrix' row");
    ++row;
  }
  if (row == kRows) return m;
  throw bad_input(file.string(),
                  fmt::format("has {} rows; expected a matrix of {} x {}", row, kRows, kColumns));
}

fs::path first_folder(const fs::path& source, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (fs::is_directory(source / name)) return source / name;
  }
  return {};
}

/// The intrinsics of depth; those of colour where there are no others.
fs::path intrinsics_file(const fs::path& source, const char* kind) {
  const std::string of_kind = fmt::format("intrinsic_{}.txt", kind);
  for (const fs::path& file : {source / "intrinsic" / of_kind, source / "intrinsics" / of_kind,
                               source / "intrinsic" / "intrinsic.txt", source / "intrinsics.txt",
                               source / "intrinsic.txt", source / "camera-intrinsics.txt"}) {
    if (fs::is_regular_file(file)) return file;
  }
  return {};
}

std::optional<int> number_of_file(const fs::path& file) {
  const std::string stem = file.stem().string();
  int number = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  const bool fits = error == std::errc() && end == stem.data() + stem.size() && number >= 0;
  return fits ? std::optional(number) : std::nullopt;
}

/// The file of this stem, whatever its ending.
fs::path image_of(const fs::path& folder, const std::string& stem,
                  std::initializer_list<const char*> endings) {
  if (folder.empty()) return {};
  for (const char* ending : endings) {
    if (fs::is_regular_file(folder / (stem + ending))) return folder / (stem + ending);
  }
  return {};
}

std::vector<std::pair<int, fs::path>> pose_files(const fs::path& folder) {
  std::vector<std::pair<int, fs::path>> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".txt") continue;
    if (const auto number = number_of_file(entry.path())) files.emplace_back(*number, entry.path());
  }
  std::ranges::sort(files);
  if (files.empty()) throw bad_input(folder.string(), "has no poses such as 0.txt");
  return files;
}

}  // namespace

bool detect_scannet(const fs::path& source) {
  return !first_folder(source, {"pose", "poses"}).empty() &&
         !(intrinsics_file(source, "depth").empty() && intrinsics_file(source, "color").empty());
}

ImportedDataset read_scannet(const fs::path& source) {
  const fs::path depth_folder = first_folder(source, {"depth"});
  const fs::path color_folder = first_folder(source, {"color", "rgb", "images"});
  fs::path file = intrinsics_file(source, depth_folder.empty() ? "color" : "depth");
  if (file.empty()) file = intrinsics_file(source, "color");
  const Eigen::Matrix3d k = read_text_matrix<3, 3>(file);
  ImportedDataset dataset{"ScanNet", 1, {}, {file}};
  std::vector<std::string> skipped;
  for (const auto& [number, pose_file] : pose_files(first_folder(source, {"pose", "poses"}))) {
    const Eigen::Matrix4d m = read_text_matrix<4, 4>(pose_file);
    const std::string stem = pose_file.stem().string();
    if (!m.allFinite()) {
      skipped.push_back(stem);
      continue;
    }
    ImportedImage image{stem, {0, 0, k(0, 0), k(1, 1), k(0, 2), k(1, 2)}, {}};
    image.T_world_cam =
        Pose::from_rotation(m.topLeftCorner<3, 3>(), m.topRightCorner<3, 1>(), pose_file.string());
    image.depth = image_of(depth_folder, stem, {".png", ".tif", ".exr", ".npy"});
    image.color = image_of(color_folder, stem, {".jpg", ".png", ".jpeg"});
    dataset.files.push_back(pose_file);
    dataset.images.push_back(std::move(image));
  }
  if (!skipped.empty()) {
    dataset.warnings.push_back(
        fmt::format("{}: left out {} images whose pose is not finite, the first being {}: tracking "
                    "was lost there",
                    source.string(), skipped.size(), skipped.front()));
  }
  return dataset;
}

}  // namespace vantage
