#include "simulate/simulation_record.hpp"
#include "process/output_folder.hpp"
#include "process/result_output.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/inputs_json.hpp"
#include "cli/volume_text.hpp"
#include "options/field_json.hpp"
#include "options/sensor_fields.hpp"
#include "simulate/workcell_export.hpp"
#include "simulator/scene/ground_truth.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"
#include "version.hpp"
#include "workcell/random_objects.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kRecordName = "simulation.json";

Json color_json(ColorSensor color) {
  const Distortion& d = color.distortion;
  Json json{{"samples_per_pixel", color.samples_per_pixel},
            {"distortion", {d.k1, d.k2, d.p1, d.p2, d.k3}}};
  if (d.model == LensModel::fisheye) {
    json["lens_model"] = "fisheye";
    json["distortion"] = {d.k1, d.k2, d.k3, d.k4};
  }
  json.update(to_json(fields_of(color)));
  return json;
}

Json depth_json(StereoSensor depth, double depth_scale_mm) {
  Json json = to_json(fields_of(depth));
  json["depth_scale_mm"] = depth_scale_mm;
  return json;
}

Json true_volumes_json(const Workcell& workcell, const SimulatedCell& cell) {
  const double voxel_size_m = workcell.voxel_size_m;
  std::vector<PinholeCamera> cameras;
  for (const CellCamera& camera : workcell.cameras) cameras.push_back(camera.camera);
  const auto geometry = GridGeometry::covering(workcell.work_area, voxel_size_m);
  const GroundTruth truth(cell.scene, cameras, geometry);
  const StateGrid& grid = truth.grid();
  const auto volume = [&](VoxelState state) { return grid.volume_m3(state); };
  return {{"voxel_size_m", voxel_size_m},
          {"occupied", volume(VoxelState::occupied)},
          {"free", volume(VoxelState::free)},
          {"hidden", volume(VoxelState::shadow)}};
}

Json images_json(const Workcell& workcell) {
  Json names = Json::array();
  for (const CellCamera& camera : workcell.cameras) names.push_back(camera.name);
  return names;
}

}  // namespace

void prepare_objects(Workcell& workcell, SimulationOptions& options) {
  choose_random_objects(workcell, options.objects, options.types);
  if (options.seed && workcell.random_objects) workcell.random_objects->seed = *options.seed;
  options.recording.seed = options.seed.value_or(0);
  place_random_objects(workcell);
}

void claim_folder(const fs::path& folder) {
  if (fs::exists(folder) && !fs::is_directory(folder)) {
    throw bad_input(folder.string(), "a file has this name; name a folder for the dataset");
  }
  if (fs::is_directory(folder) && !fs::is_empty(folder) &&
      !fs::is_regular_file(folder / kRecordName)) {
    throw bad_input(folder.string(),
                    "the folder is not empty, and its files were not written by a simulation; name "
                    "another one, so that nothing is lost");
  }
  make_output_folder(folder);
  for (const char* last : {"scene_camera.json", "sequence.json"}) fs::remove(folder / last);
}

Json write_simulation_record(const fs::path& workcell_file, const Workcell& workcell,
                             const SimulatedCell& cell, const SimulationOptions& options,
                             const fs::path& folder) {
  const RecordingOptions& recording = options.recording;
  const Json record{{"vantage", kVersion},
                    {"workcell", workcell_file.string()},
                    {"seed", recording.seed},
                    {"images", images_json(workcell)},
                    {"color", color_json(recording.color)},
                    {"depth", depth_json(recording.depth, recording.depth_scale_mm)},
                    {"known_objects", workcell.known_objects.size()},
                    {"foreign_objects", workcell.foreign_objects.size()},
                    {"true_volumes_m3", true_volumes_json(workcell, cell)},
                    {"inputs", inputs_json(workcell.files)}};
  write_cell_bundle(workcell_file, workcell, calibration_names(workcell, recording), folder);
  write_file(folder / kRecordName, json_text(record));
  return record;
}

std::string summary_of_simulation(const Json& record) {
  const Json& volumes = record["true_volumes_m3"];
  std::string cameras;
  for (const Json& name : record["images"]) {
    cameras += (cameras.empty() ? "" : ", ") + name.get<std::string>();
  }
  const auto volume = [&](const char* key) { return volume_text(volumes[key].get<double>()); };
  return fmt::format(
      "images     {} ({})\nobjects    {} known, {} foreign\n"
      "truth      occupied {}, free {}, hidden {}, voxels of {} m\n",
      record["images"].size(), cameras, record["known_objects"].get<int>(),
      record["foreign_objects"].get<int>(), volume("occupied"), volume("free"), volume("hidden"),
      volumes["voxel_size_m"].get<double>());
}

}  // namespace vantage
