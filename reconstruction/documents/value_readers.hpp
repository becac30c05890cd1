#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "documents/document_value.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

/// Parts that several of our files have. All throw Error bad_input with the value's place for what
/// no schema can say.

Box read_box(const Value& value);
DepthRange read_range(const Value& value);
Intrinsics read_intrinsics(const Value& value);
Eigen::Quaterniond read_quaternion(const Value& value);
/// The rotation as a quaternion, `rpy_rad`, or by what the z axis looks at; or the whole `matrix`.
Pose read_pose(const Value& value);
Eigen::Vector3f read_color(const Value& value);

/// The file that a value names, relative to the folder of the file that it stands in. Adds it to
/// `files` unless it is there.
/// @throws Error bad_input if there is no such file.
std::filesystem::path named_file(const Value& value, const std::filesystem::path& folder,
                                 std::vector<std::filesystem::path>& files);

/// The same for what may be a folder, too.
std::filesystem::path named_file_or_folder(const Value& value, const std::filesystem::path& folder,
                                           std::vector<std::filesystem::path>& files);

}  // namespace vantage
