#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/reconstruction/bop_scene.hpp"
#include "vantage/reconstruction/locate_camera.hpp"
#include "vantage/reconstruction/observation.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

/// Where a camera's pose comes from.
enum class CameraSource {
  automatic,  ///< the dataset if it has the camera's pose, else the board
  board,      ///< the markers of the board
  dataset,
};

/// @throws Error bad_input, "--cameras" as the place, for another name.
CameraSource camera_source_of(const std::string& name);

/// How to make features of pictures.
struct ObserveOptions {
  /// Calibration files, as `lenses_of` has them. Empty: the workcell's, else the dataset's
  /// intrinsics, without distortion.
  std::vector<std::filesystem::path> calibrations = {};
  std::vector<std::filesystem::path> observations = {};  ///< of other detectors, as JSON lines
  bool detect_markers = true;                            ///< in the pictures
  CameraSource cameras = CameraSource::automatic;
  LocateOptions locate = {};
};

/// The command line's calibrations, or else the workcell's.
const std::vector<std::filesystem::path>& calibrations_of(const Workcell& workcell,
                                                          const ObserveOptions& options);

/// What the cameras saw. One element for each of the scene's images, in all lists.
struct ObservedScene {
  std::vector<CameraView> views;                ///< without what they saw of the board
  std::vector<std::vector<Observation>> board;  ///< what they saw of it
  std::vector<CameraLocation> locations;        ///< by the board; empty where it was not asked
  std::vector<std::filesystem::path> files;     ///< that were read for it
  double detect_s = 0;
  double locate_s = 0;
};

/// Reads a dataset: a BOP scene folder, or one with photographs if there is a calibration.
/// @throws Error bad_input as `load_bop_scene`, `load_photographs` and `read_calibration` do.
BopScene load_dataset(const std::filesystem::path& folder, const Workcell& workcell,
                      std::span<const int> only_ids, const ObserveOptions& options);

/// Detects features in all pictures and locates the cameras. A camera that cannot be located has no
/// T_world_cam, and its location says why. Runs in the caller's task arena.
/// @throws Error bad_input as `read_calibration` and `read_observations` do, for as many
/// calibrations as there are not images, for observations of images that are not there, for a
/// camera with neither a pose nor a board to locate it by, and for a picture that is damaged.
ObservedScene observe(const BopScene& scene, const Workcell& workcell,
                      const ObserveOptions& options, const StopToken& stop = {});

/// The located cameras that have depth images.
/// @param depth_is_pinhole whether the depth images are a pinhole's although a lens distorts; if
/// nobody says so, those of lenses that distort by a pixel or more are left out.
std::vector<DepthCamera> depth_cameras(const BopScene& scene, const ObservedScene& observed,
                                       bool depth_is_pinhole);

}  // namespace vantage
