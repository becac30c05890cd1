#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "vantage/raycore/export.hpp"
#include "vantage/reconstruction/observation.hpp"

namespace vantage {

/// Reads what an external detector saw: JSON lines, one observation each, as
/// assets/schema/observation.schema.json describes them, by image id. For example
///   {"image": 3, "type": "aruco", "dictionary": "4X4_50", "value": 7, "corners_px": [[1, 2], …]}
///   {"image": 3, "type": "keypoint", "value": "spout", "points_px": [[310.2, 200.5]], "sigma_px":
///   1}
///   {"image": 3, "type": "pose", "value": "obj_000001", "T_cam_feature": {"rotation": {…},
///   "translation_m": […]}}
///   {"image": 3, "type": "color", "value": "red", "point_m": [0.1, 0, 0.8]}
/// Where a number should be – but for those of a pose – null, "NaN" and "Infinity" are read as NaN:
/// `fault_of` names them later. Blank lines are skipped; a file without lines is one of a detector
/// that saw nothing.
/// @throws Error bad_input with file and line for what is not as the schema has it, for a marker
/// that its dictionary does not have, for a key that does not belong to the others, and for a file
/// that is missing or above 64 MiB.
VANTAGE_API std::map<int, std::vector<Observation>> read_observations(
    const std::filesystem::path& file);

}  // namespace vantage
