#include "documents/value_readers.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vantage {

namespace fs = std::filesystem;

Box read_box(const Value& value) {
  return Box(value["min_m"].vector(), value["max_m"].vector(), value.place());
}

DepthRange read_range(const Value& value) {
  const DepthRange range{value.number(0), value.number(1)};
  range.check(value.place());
  return range;
}

Intrinsics read_intrinsics(const Value& value) {
  const Intrinsics intrinsics{value["width"].as<int>(), value["height"].as<int>(),
                              value["fx"].as<double>(), value["fy"].as<double>(),
                              value["cx"].as<double>(), value["cy"].as<double>()};
  intrinsics.check(value.place());
  return intrinsics;
}

Eigen::Quaterniond read_quaternion(const Value& value) {
  const Eigen::Quaterniond found(value["w"].as<double>(), value["x"].as<double>(),
                                 value["y"].as<double>(), value["z"].as<double>());
  return Pose::from_quaternion(found, Eigen::Vector3d::Zero(), value.place()).quaternion();
}

Pose read_pose(const Value& value) {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  if (value.has("translation_m")) translation = value["translation_m"].vector();
  if (!value.has("rotation")) return Pose::from_translation(translation);
  const Eigen::Quaterniond rotation = read_quaternion(value["rotation"]);
  return Pose::from_quaternion(rotation, translation, value.place());
}

Eigen::Vector3f read_color(const Value& value) {
  return value.vector().cast<float>();
}

namespace {

fs::path named(const Value& value, const fs::path& folder, bool may_be_folder,
               std::vector<fs::path>& files) {
  const fs::path file = folder / value.as<std::string>();
  std::error_code unused;
  const fs::file_status status = fs::status(file, unused);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) {
    throw value.error(
        fmt::format("{} is a device, a pipe or a socket; expected a regular file", file.string()));
  }
  if (fs::is_directory(status) && !may_be_folder) {
    throw value.error(fmt::format("{} is a folder; expected a file", file.string()));
  }
  if (!fs::exists(status)) {
    throw value.error(
        fmt::format("there is no file{} {}; the path is relative to the folder of the "
                    "file that names it",
                    may_be_folder ? " or folder" : "", file.string()));
  }
  if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  return file;
}

}  // namespace

fs::path named_file(const Value& value, const fs::path& folder, std::vector<fs::path>& files) {
  return named(value, folder, false, files);
}

fs::path named_file_or_folder(const Value& value, const fs::path& folder,
                              std::vector<fs::path>& files) {
  return named(value, folder, true, files);
}

}  // namespace vantage
