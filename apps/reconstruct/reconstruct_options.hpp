#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reconstruct/scene_reconstruction.hpp"

namespace vantage {

/// What the command line says of reconstructing; verbs that reconstruct share it.
struct ReconstructCommandOptions {
  std::string method = "pnp";
  std::string cameras = "auto";
  std::string depth_lens = "auto";  ///< of verbs that use depth images
  std::vector<std::filesystem::path> calibrations, features;
  bool no_markers = false, no_ambiguous = false;
  double inlier_px = ReconstructOptions().inlier_px;

  /// All but --method, whose name verbs differ in, and --depth-lens.
  void add_to(CLI::App& verb);
  void add_depth_lens_to(CLI::App& verb);
};

/// @throws Error bad_input for a method or a camera source that does not exist.
SceneReconstructionOptions options_of(const ReconstructCommandOptions& options);

/// For world.json's `config`.
nlohmann::ordered_json config_of(const ReconstructCommandOptions& options);

}  // namespace vantage
