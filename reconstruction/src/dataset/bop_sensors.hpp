#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vantage::reconstruction::detail {

/// One sensor of a BOP scene. Most scenes have one, without a name.
struct BopSensor {
  std::filesystem::path camera_file;  ///< scene_camera.json, or scene_camera_cam1.json
  std::string suffix;                 ///< of its folders: "", or "_cam1" as in depth_cam1/
  int first_id = 0;                   ///< what its images' ids count from
};

/// Images of the k-th sensor have ids from k times this.
inline constexpr int kIdsPerSensor = 1'000'000;

/// The sensors of a scene in the order of their names; empty if the folder is no BOP scene.
/// @throws Error bad_input for more than 1000.
std::vector<BopSensor> sensors_of(const std::filesystem::path& folder);

}  // namespace vantage::reconstruction::detail
