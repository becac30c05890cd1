#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "simulate/bop_models.hpp"
#include "simulator/color/color_sensor.hpp"
#include "simulator/depth/depth_sensor.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "workcell/simulated_cell.hpp"

namespace vantage {

/// How a cell is recorded.
struct RecordingOptions {
  ColorSensor color = {};
  StereoSensor depth = {};
  Lighting lighting = {};
  double depth_scale_mm = 0.1;  ///< one count of the depth images; 16 bits reach 6.55 m with it
  std::uint64_t seed = 0;       ///< of all noise; image i uses a hash of it and i
};

/// @throws Error bad_input for a workcell without cameras, one whose depth range does not fit 16
/// bits, and as `StereoSensor::check` and `Lens` do.
void check_recording(const Workcell& workcell, const RecordingOptions& options);

/// The calibration files that a recording gets: none without distortion, `calibration.yml` if all
/// cameras are alike, else one for each.
std::vector<std::string> calibration_names(const Workcell& workcell,
                                           const RecordingOptions& options);

/// What one camera looks at.
struct RecordedScene {
  const SimulatedScene* scene = nullptr;
  std::span<const PlacedObject> known_objects;  ///< the truth
};

/// Records one image of each camera into a BOP scene folder: `rgb/`, `depth/`, `scene_gt.json` and,
/// last, `scene_camera.json`.
/// @param scenes one for each camera.
/// @param seed of all noise; image i uses a hash of it and i.
/// @returns whether it is complete: not if `stop` asked to stop.
bool record_images(std::span<const CellCamera> cameras, std::span<const RecordedScene> scenes,
                   const std::vector<BopModel>& models, const RecordingOptions& options,
                   std::uint64_t seed, const std::filesystem::path& folder, const StopToken& stop);

/// Writes the files of `calibration_names`.
void write_calibrations(const Workcell& workcell, const RecordingOptions& options,
                        const std::filesystem::path& folder);

/// Records the cell with all of its cameras as a BOP scene folder: `rgb/` and `depth/` with image i
/// for the i-th camera, `models/`, `scene_gt.json` with the known objects, `scene_camera.json`; and
/// `calibration.yml`, OpenCV's, if the colour camera's lens distorts (`calibration_%06d.yml` for
/// each image, where intrinsics differ). `scene_camera.json` comes last: a folder without it is no
/// recording yet.
/// @returns whether it is complete: not if `stop` asked to stop.
/// @throws Error as `check_recording`, the sensors and `write_file` do.
bool record(const Workcell& workcell, const SimulatedCell& cell, const RecordingOptions& options,
            const std::filesystem::path& folder, const StopToken& stop = {});

}  // namespace vantage
