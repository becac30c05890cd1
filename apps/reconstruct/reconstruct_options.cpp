#include "reconstruct/reconstruct_options.hpp"

#include "cli/help_formatter.hpp"
#include "cli/number_checks.hpp"

namespace vantage {

void ReconstructCommandOptions::add_to(CLI::App& verb) {
  const char* heading = "Known objects";
  verb.add_option("--cameras", cameras,
                  "Where the camera poses come from; dataset; board: the workcell's markers; auto: "
                  "the board where the dataset has no pose")
      ->check(CLI::IsMember({"auto", "board", "dataset"}))
      ->capture_default_str()
      ->group(heading);
  verb.add_option(
          "--calibration", calibrations,
          "Calibration by OpenCV, ROS or Kalibr: one file for all cameras, one for each image "
          "in the order of their ids, or by id (0=a.yml,2=b.yml); FILE#CAMERA where a file "
          "has several; overrides the workcell's")
      ->delimiter(',')
      ->option_text("[ID=]FILE,…")
      ->group(heading);
  verb.add_option(
          "--features", features,
          "Features from other detectors: JSON lines, see assets/schema/observation.schema.json")
      ->delimiter(',')
      ->option_text("FILE,…")
      ->group(heading);
  verb.add_flag("--no-markers", no_markers, "Do not detect markers in the images")
      ->needs(verb.get_option("--features"))
      ->group(heading);
  verb.add_option("--inlier-px", inlier_px,
                  "Largest reprojection error of a feature that belongs to an object, pixels")
      ->check(positive_number())
      ->capture_default_str()
      ->group(expert_group(heading));
  verb.add_flag("--no-ambiguous", no_ambiguous,
                "Leave out objects seen by one camera with one marker, whose tilt is ambiguous")
      ->group(expert_group(heading));
}

void ReconstructCommandOptions::add_depth_lens_to(CLI::App& verb) {
  verb.add_option(
          "--depth-lens", depth_lens,
          "How depth images were taken, where the calibration's lens distorts; pinhole: they "
          "are rectified; calibrated: registered to the colour images, and distorted as they "
          "are; auto: the workcell's, or pinhole with a warning")
      ->check(CLI::IsMember({"auto", "pinhole", "calibrated"}))
      ->capture_default_str()
      ->group("Known objects");
}

SceneReconstructionOptions options_of(const ReconstructCommandOptions& arguments) {
  SceneReconstructionOptions settings;
  settings.method = reconstruction_method_of(arguments.method);
  settings.observe.calibrations = arguments.calibrations;
  settings.observe.observations = arguments.features;
  settings.observe.detect_markers = !arguments.no_markers;
  settings.observe.cameras = camera_source_of(arguments.cameras);
  settings.observe.locate.inlier_px = arguments.inlier_px;
  settings.options.inlier_px = arguments.inlier_px;
  settings.options.keep_ambiguous = !arguments.no_ambiguous;
  return settings;
}

nlohmann::ordered_json config_of(const ReconstructCommandOptions& arguments) {
  const auto names = [](const std::vector<std::filesystem::path>& files) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const auto& file : files) list.push_back(file.string());
    return list;
  };
  return {{"method", arguments.method},
          {"cameras", arguments.cameras},
          {"calibration", names(arguments.calibrations)},
          {"features", names(arguments.features)},
          {"detect_markers", !arguments.no_markers},
          {"inlier_px", arguments.inlier_px},
          {"keep_ambiguous", !arguments.no_ambiguous}};
}

}  // namespace vantage
