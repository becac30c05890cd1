#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "cli/command.hpp"
#include "cli/number_checks.hpp"
#include "cli/progress_line.hpp"
#include "cli/shared_options.hpp"
#include "cli/signal_handler.hpp"
#include "import/dataset_writer.hpp"
#include "process/result_output.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/reconstruction/bop_scene.hpp"
#include "vantage/reconstruction/calibration.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

struct ImportOptions {
  fs::path source, folder, calibration;
  ImportChoice choice;
  bool json = false;
};

ImportedDataset read_source(const ImportOptions& options) {
  const ReadingPhase reading;
  const fs::path& source = options.source;
  if (!fs::is_directory(source)) {
    throw bad_input(source.string(), "no such folder; expected the folder of a recording");
  }
  std::optional<Lens> lens;
  if (!options.calibration.empty()) lens = read_calibration(options.calibration);
  const bool is_tum = detect_tum(source);
  if (lens && !is_tum) {
    throw bad_input("--calibration",
                    "only a TUM RGB-D folder lacks intrinsics; this one is of "
                    "another format, and has its own");
  }
  if (is_tum) return read_tum(source, lens);
  if (detect_nerfstudio(source)) return read_nerfstudio(source);
  if (detect_colmap(source)) return read_colmap(source);
  if (detect_scannet(source)) return read_scannet(source);
  throw bad_input(
      source.string(),
      is_bop_scene(source)
          ? "is a BOP scene, which vantage reads as it is; no import is needed"
          : "is of no format that can be imported; expected rgb.txt and depth.txt (TUM RGB-D), "
            "transforms.json (nerfstudio), cameras.txt and images.txt (COLMAP), or pose/ and "
            "intrinsic/ (ScanNet)");
}

std::string summary_of_import(const nlohmann::ordered_json& record, const fs::path& folder) {
  const std::string calibration = record["calibration"].get<std::string>();
  return fmt::format(
      "format     {}\nimages     {}{}\nnext       vantage plan {}{} --workcell FILE\n",
      record["format"].get<std::string>(), record["images"].size(),
      record["depth"].get<bool>()
          ? fmt::format(", depth of {} mm a count", record["depth_scale_mm"].get<double>())
          : ", without depth",
      folder.string(), calibration.empty() ? "" : " --calibration " + calibration);
}

ExitCode import_dataset(const ImportOptions& options) {
  const StopToken stop;
  const SignalHandler interrupt({stop});
  ImportedDataset dataset = read_source(options);
  nlohmann::ordered_json record;
  {
    const ProgressLine progress("importing", stop);
    record = write_imported(dataset, options.choice, options.folder, stop);
  }
  for (const std::string& warning : dataset.warnings) spdlog::warn("{}", warning);
  print_result(options.json, record, [&] { return summary_of_import(record, options.folder); });
  return ExitCode::ok;
}

}  // namespace

void add_import_command(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(
      "import", "Make a dataset of a recording by TUM RGB-D, nerfstudio, COLMAP or ScanNet");
  const auto options = std::make_shared<ImportOptions>();
  verb->add_option("source", options->source, "Folder of the recording; its format is found out")
      ->required();
  add_output_option(*verb, options->folder, "the dataset")->required();
  verb->add_option("--every", options->choice.every, "Take each N-th image only")
      ->option_text("N")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str()
      ->group("Input");
  verb->add_option("--images", options->choice.images,
                   "Take these images only, numbered from 0, e.g. 0,20,40")
      ->delimiter(',')
      ->group("Input");
  verb->add_option("--depth-scale-mm", options->choice.depth_scale_mm,
                   "Millimetres of one count of the depth images, if not as the format has it")
      ->check(positive_number())
      ->group("Input");
  verb->add_option("--calibration", options->calibration,
                   "Calibration of the camera, for a TUM RGB-D folder, which has none")
      ->option_text("FILE")
      ->group("Input");
  add_json_flag(*verb, options->json, "import.json");
  verb->footer(
      "Examples:\n"
      "  vantage import rgbd_dataset_freiburg1_desk --every 20 -o desk\n"
      "  vantage import my_nerfstudio_capture --images 0,12,31 -o capture\n"
      "  vantage import my_colmap_project --depth-scale-mm 0.25 -o project");
  verb->parse_complete_callback(
      [&action, options] { action = [=] { return import_dataset(*options); }; });
}

}  // namespace vantage
