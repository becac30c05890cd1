#pragma once

#include <filesystem>
#include <vector>

#include "documents/document_value.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

/// T_world_cam of a value with `eye_m` and `target_m`; the image is upright.
/// @throws Error bad_input if both are the same point.
Pose read_looking_at(const Value& value);

/// The poses of a file of views, as assets/schema/views.schema.json describes it; YAML or JSON.
/// @throws Error bad_input with file, line and key for what is not as the schema has it, and for
/// invalid poses.
std::vector<Pose> read_view_file(const std::filesystem::path& file);

/// The poses of a value that is a list of views, or that names a file of them, relative to
/// `folder`; the file is added to `files`.
std::vector<Pose> read_views(const Value& value, const std::filesystem::path& folder,
                             std::vector<std::filesystem::path>& files);

}  // namespace vantage
