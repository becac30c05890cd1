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

namespace {

Pose read_matrix(const Value& value) {
  const std::vector<Value> rows = value.elements();
  Eigen::Matrix4d m;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) m(i, j) = rows[std::size_t(i)].number(std::size_t(j));
  }
  if (m.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    throw rows[3].error(
        "the last row of a pose's matrix is [0, 0, 0, 1]; expected row by row, with the rotation "
        "on the left and the translation in metres on the right");
  }
  return Pose::from_rotation(m.topLeftCorner<3, 3>(), m.topRightCorner<3, 1>(), value.place());
}

/// Roll around x, then pitch around y, then yaw around z, all of them the fixed frame's (URDF).
Eigen::Matrix3d rotation_of_rpy(const Eigen::Vector3d& rpy) {
  return (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

void check_one_rotation(const Value& value) {
  const char* first = nullptr;
  for (const char* key : {"rotation", "rpy_rad", "look_at_m", "matrix"}) {
    if (!value.has(key)) continue;
    if (first) {
      throw value[key].error(
          fmt::format("the rotation is given twice, by {} and by {}; remove one "
                      "of them",
                      first, key));
    }
    first = key;
  }
  if (value.has("matrix") && value.has("translation_m")) {
    throw value["translation_m"].error(
        "the matrix already contains the translation; remove this key");
  }
}

}  // namespace

Pose read_pose(const Value& value) {
  check_one_rotation(value);
  if (value.has("matrix")) return read_matrix(value["matrix"]);
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  if (value.has("translation_m")) translation = value["translation_m"].vector();
  if (value.has("rpy_rad")) {
    return Pose::from_rotation(rotation_of_rpy(value["rpy_rad"].vector()), translation,
                               value.place());
  }
  if (value.has("look_at_m")) {
    const Eigen::Vector3d target = value["look_at_m"].vector();
    if (target == translation)
      throw value["look_at_m"].error(
          "it is the position of the pose itself; expected another point");
    return Pose::looking_at(translation, target);
  }
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
