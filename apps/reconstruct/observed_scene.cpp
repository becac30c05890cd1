#include "reconstruct/observed_scene.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "cli/run_time.hpp"
#include "cli/signal_handler.hpp"
#include "reconstruct/calibration_list.hpp"
#include "reconstruct/missing_markers.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/rectify_depth.hpp"
#include "vantage/reconstruction/calibration.hpp"
#include "vantage/reconstruction/color_image.hpp"
#include "vantage/reconstruction/detector.hpp"
#include "vantage/reconstruction/observation_file.hpp"
#include "workcell/marker_dictionaries.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

/// Appends what other detectors saw.
void add_from_files(const BopScene& scene, ObservedScene& observed,
                    const std::vector<fs::path>& files) {
  const ReadingPhase reading;
  for (const fs::path& file : files) {
    for (auto& [id, seen] : read_observations(file)) {
      const auto image = std::ranges::find(scene.images, id, &BopImage::id);
      if (image == scene.images.end()) {
        throw bad_input(file.string(), fmt::format("there are observations of image {}, but the "
                                                   "dataset has no such image",
                                                   id));
      }
      auto& all = observed.views[std::size_t(image - scene.images.begin())].observations;
      all.insert(all.end(), seen.begin(), seen.end());
    }
    observed.files.push_back(file);
  }
}

void detect(const BopScene& scene, const Workcell& workcell, ObservedScene& observed,
            const StopToken& stop) {
  const std::vector<std::string> dictionaries = dictionaries_of(workcell);
  if (dictionaries.empty()) return;
  tbb::parallel_for(std::size_t(0), scene.images.size(), [&](std::size_t i) {
    CameraView& view = observed.views[i];
    if (!scene.images[i].color.empty() && !stop.stop_requested()) {
      const ArucoDetector detector({dictionaries, view.lens});
      view.observations = detector.detect(read_color(scene.images[i].color));
    }
    stop.advance(1);
  });
}

/// Moves what was seen of the board from `view` to `board`.
void take_board(const std::set<FeatureKey>& keys, CameraView& view,
                std::vector<Observation>& board) {
  const auto is_board = [&](const Observation& seen) { return keys.contains(seen.key); };
  std::copy_if(view.observations.begin(), view.observations.end(), std::back_inserter(board),
               is_board);
  std::erase_if(view.observations, is_board);
}

/// The camera's pose, as the dataset has it or as the board's markers say.
void place(const BopImage& image, const std::vector<ObjectFeature>& board, CameraSource source,
           const LocateOptions& options, std::span<const Observation> seen, CameraView& view,
           CameraLocation& location) {
  const bool from_dataset = source == CameraSource::dataset ||
                            (source == CameraSource::automatic && image.T_world_cam.has_value());
  if (from_dataset || board.empty()) {
    view.T_world_cam = image.camera().T_world_cam();  // or says what is missing
    return;
  }
  location = locate_camera(view.lens, seen, board, options);
  if (!location.pose) return;
  view.T_world_cam = location.pose->T_world_cam;
  view.covariance = location.pose->covariance;
}

/// Adds to the reasons of cameras that see nothing of the board what their pictures show instead.
/// Two pictures tell enough.
void explain_missing_markers(const BopScene& scene, const Workcell& workcell, const StopToken& stop,
                             ObservedScene& observed) {
  const std::vector<std::string> dictionaries = dictionaries_of(workcell);
  int left = 2;
  for (std::size_t i = 0; i < scene.images.size() && !dictionaries.empty(); ++i) {
    const bool located_by_board = !observed.locations[i].reason.empty();
    if (!located_by_board || !observed.board[i].empty() || scene.images[i].color.empty()) continue;
    if (left-- == 0 || stop.stop_requested()) return;
    const std::string hint = missing_markers_hint(read_color(scene.images[i].color), dictionaries);
    if (!hint.empty()) observed.locations[i].reason += "; " + hint;
  }
}

}  // namespace

const std::vector<fs::path>& calibrations_of(const Workcell& workcell,
                                             const ObserveOptions& options) {
  return options.calibrations.empty() ? workcell.calibrations : options.calibrations;
}

CameraSource camera_source_of(const std::string& name) {
  if (name == "auto") return CameraSource::automatic;
  if (name == "board") return CameraSource::board;
  if (name == "dataset") return CameraSource::dataset;
  throw bad_input("--cameras", fmt::format("found {}; expected auto, board or dataset", name));
}

BopScene load_dataset(const fs::path& folder, const Workcell& workcell,
                      std::span<const int> only_ids, const ObserveOptions& options) {
  const ReadingPhase reading;
  const std::vector<fs::path>& calibrations = calibrations_of(workcell, options);
  const bool is_scene = is_bop_scene(folder) || !fs::is_directory(folder);
  if (is_scene) return load_bop_scene(folder, workcell.sensor_range, only_ids);
  if (calibrations.size() != 1) {
    throw bad_input((folder / "scene_camera.json").string(),
                    "missing; expected a BOP scene folder, or photographs by one camera and its "
                    "calibration (--calibration camera.yml); for recordings by TUM RGB-D, "
                    "nerfstudio, COLMAP and ScanNet run vantage import first");
  }
  BopScene scene = load_photographs(folder, read_calibration(calibrations.front()).intrinsics(),
                                    workcell.sensor_range);
  if (!only_ids.empty()) {
    std::erase_if(scene.images, [&](const BopImage& image) {
      return std::find(only_ids.begin(), only_ids.end(), image.id) == only_ids.end();
    });
  }
  if (!scene.images.empty()) return scene;
  throw bad_input("--images",
                  "the folder has no photograph with this number; they are numbered from 0 in the "
                  "order of their names");
}

ObservedScene observe(const BopScene& scene, const Workcell& workcell,
                      const ObserveOptions& options, const StopToken& stop) {
  const std::vector<fs::path>& calibrations = calibrations_of(workcell, options);
  const std::vector<ObjectFeature> board =
      workcell.board ? workcell.board->features() : std::vector<ObjectFeature>();
  if (options.cameras == CameraSource::board && board.empty()) {
    throw bad_input("--cameras board", "the workcell has no board with markers to locate them by");
  }
  const std::size_t count = scene.images.size();
  ObservedScene observed{{},
                         std::vector<std::vector<Observation>>(count),
                         std::vector<CameraLocation>(count),
                         calibration_files(calibrations)};
  const std::vector<Lens> lenses = lenses_of(scene, calibrations);
  for (std::size_t i = 0; i < count; ++i) {
    observed.views.push_back({std::to_string(scene.images[i].id), lenses[i]});
  }
  auto start = StopToken::Clock::now();
  if (options.detect_markers) detect(scene, workcell, observed, stop);
  observed.detect_s = seconds_since(start);
  add_from_files(scene, observed, options.observations);

  start = StopToken::Clock::now();
  std::set<FeatureKey> keys;
  for (const ObjectFeature& feature : board) keys.insert(feature.key);
  tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
    take_board(keys, observed.views[i], observed.board[i]);
    place(scene.images[i], board, options.cameras, options.locate, observed.board[i],
          observed.views[i], observed.locations[i]);
  });
  if (options.detect_markers) explain_missing_markers(scene, workcell, stop, observed);
  observed.locate_s = seconds_since(start);
  return observed;
}

std::vector<DepthCamera> depth_cameras(const BopScene& scene, const ObservedScene& observed,
                                       bool depth_is_pinhole) {
  constexpr double kVisible_px = 1;
  std::vector<DepthCamera> cameras;
  for (std::size_t v = 0; v < scene.images.size(); ++v) {
    const BopImage& image = scene.images[v];
    const CameraView& view = observed.views[v];
    if (!image.depth || !view.T_world_cam) continue;
    if (!depth_is_pinhole && max_displacement_px(view.lens) > kVisible_px) continue;
    cameras.push_back({view.name,
                       PinholeCamera(image.intrinsics, *view.T_world_cam, image.range, image.place),
                       image.depth});
  }
  return cameras;
}

}  // namespace vantage
