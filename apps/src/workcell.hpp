#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

#include "vantage/planner/view_candidates.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

/// What a workcell file says; assets/schema/workcell.schema.json describes the keys.
struct Workcell {
  Box work_area;
  DepthRange sensor_range = {};                       ///< of the dataset's cameras
  std::optional<Intrinsics> movable_intrinsics = {};  ///< none: like the dataset's first camera
  DepthRange movable_range = {};
  std::vector<double> candidate_radii_m = {};  ///< empty: from the work area's size
  int candidates_per_half_sphere = 20;
  std::optional<Reach> reach = {};
  std::vector<KnownObject> static_structures = {};  ///< may lie outside the work area
  std::vector<KnownObject> known_objects = {};
  std::optional<double> voxel_size_m = {};
  VolumeOptions volume = {};
  std::vector<std::filesystem::path> files = {};  ///< every file that was read, once
};

/// Reads a workcell and the meshes that it names, relative to its folder.
/// @throws Error bad_input with file, line and key for anything that is not as the schema has it, a
/// box without volume, a quaternion that is none, ranges the wrong way round, a name used twice and
/// a mesh that is not there; with the mesh file for one that is damaged.
Workcell load_workcell(const std::filesystem::path& path);

}  // namespace vantage
