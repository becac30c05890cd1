#include "simulate/simulated_dataset.hpp"
#include "process/output_folder.hpp"
#include "process/result_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/pose_json.hpp"
#include "cli/units.hpp"
#include "simulator/scene/sample_hash.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/image_io.hpp"
#include "vantage/raycore/lens.hpp"
#include "vantage/reconstruction/calibration.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json camera_json(const PinholeCamera& camera, double depth_scale_mm) {
  const Intrinsics& k = camera.intrinsics();
  const Pose T_cam_world = camera.T_world_cam().inverse();
  return {{"cam_K", {k.fx, 0.0, k.cx, 0.0, k.fy, k.cy, 0.0, 0.0, 1.0}},
          {"depth_scale", depth_scale_mm},
          {"cam_R_w2c", bop_rotation(T_cam_world)},
          {"cam_t_w2c", bop_translation(T_cam_world)}};
}

Json truth_json(std::span<const PlacedObject> objects, const std::vector<BopModel>& models,
                const PinholeCamera& camera) {
  Json list = Json::array();
  for (const PlacedObject& object : objects) {
    const Pose T_cam_model = camera.T_world_cam().inverse() * object.T_world_object;
    list.push_back({{"cam_R_m2c", bop_rotation(T_cam_model)},
                    {"cam_t_m2c", bop_translation(T_cam_model)},
                    {"obj_id", model_of(models, object).id}});
  }
  return list;
}

RawDepthImage to_counts(const DepthImage& depth, double depth_scale_mm) {
  RawDepthImage counts(depth.width(), depth.height());
  for (std::size_t i = 0; i < counts.samples.size(); ++i) {
    const double z = double(depth.metres()[i]);
    if (std::isnan(z)) continue;
    counts.samples[i] = std::uint16_t(std::lround(kMillimetres * z / depth_scale_mm));
  }
  return counts;
}

void check_depth_range(const CellCamera& camera, double depth_scale_mm) {
  const double most = 65535 * depth_scale_mm / kMillimetres, far_m = camera.camera.range().far_m;
  if (far_m <= most) return;
  throw bad_input("--depth-scale-mm",
                  fmt::format("{} mm per count reach {} m in 16 bits, but camera {} measures up to "
                              "{} m; use {} or more, or a shorter sensor.depth_range_m",
                              depth_scale_mm, most, camera.name, far_m,
                              std::ceil(far_m * kMillimetres / 65535 * 100) / 100));
}

}  // namespace

std::vector<std::string> calibration_names(const Workcell& workcell,
                                           const RecordingOptions& options) {
  if (options.color.distortion.none() || workcell.cameras.empty()) return {};
  const Intrinsics& first = workcell.cameras.front().camera.intrinsics();
  const bool all_alike =
      std::all_of(workcell.cameras.begin(), workcell.cameras.end(),
                  [&](const CellCamera& c) { return c.camera.intrinsics() == first; });
  if (all_alike) return {"calibration.yml"};
  std::vector<std::string> names;
  for (std::size_t i = 0; i < workcell.cameras.size(); ++i) {
    names.push_back(fmt::format("calibration_{:06}.yml", i));
  }
  return names;
}

void check_recording(const Workcell& workcell, const RecordingOptions& options) {
  if (workcell.cameras.empty()) {
    throw bad_input(workcell.files.front().string() + ": cameras",
                    "there are no cameras; simulating needs at least one, e.g. \"- {name: front, "
                    "eye_m: [0, -0.7, 0.4], target_m: [0, 0, 0]}\"");
  }
  options.depth.check("depth sensor");
  for (const CellCamera& camera : workcell.cameras) {
    check_depth_range(camera, options.depth_scale_mm);
    const bool fisheye = options.color.distortion.model == LensModel::fisheye;
    const Lens lens(camera.camera.intrinsics(), options.color.distortion,
                    fisheye ? "--fisheye" : "--distortion");  // or why it is none
    if (!lens.covers_image()) lens.sight(-0.5, -0.5, {});     // likewise
  }
}

void write_calibrations(const Workcell& workcell, const RecordingOptions& options,
                        const fs::path& folder) {
  const std::vector<std::string> names = calibration_names(workcell, options);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Lens lens(workcell.cameras[i].camera.intrinsics(), options.color.distortion);
    write_file(folder / names[i], calibration_yaml(lens));
  }
}

bool record_images(std::span<const CellCamera> cameras, std::span<const RecordedScene> scenes,
                   const std::vector<BopModel>& models, const RecordingOptions& options,
                   std::uint64_t base_seed, const fs::path& folder, const StopToken& stop) {
  for (const char* name : {"rgb", "depth"}) make_output_folder(folder / name);
  Json camera_list = Json::object(), truth = Json::object();
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const PinholeCamera& camera = cameras[i].camera;
    const SimulatedScene& scene = *scenes[i].scene;
    const std::uint64_t seed = sample_hash(base_seed, i);
    const auto color = simulate_color(scene, options.lighting, camera, options.color, seed, stop);
    if (!color || stop.stop_requested()) return false;
    const DepthImage depth = simulate_depth(scene.rays(), camera, options.depth, seed);
    const std::string name = fmt::format("{:06}.png", i);
    write_png(folder / "rgb" / name, *color);
    write_png(folder / "depth" / name, to_counts(depth, options.depth_scale_mm));
    camera_list[std::to_string(i)] = camera_json(camera, options.depth_scale_mm);
    truth[std::to_string(i)] = truth_json(scenes[i].known_objects, models, camera);
    stop.advance(1);
  }
  write_file(folder / "scene_gt.json", json_text(truth));
  write_file(folder / "scene_camera.json", json_text(camera_list));
  return true;
}

bool record(const Workcell& workcell, const SimulatedCell& cell, const RecordingOptions& options,
            const fs::path& folder, const StopToken& stop) {
  check_recording(workcell, options);
  make_output_folder(folder / "models");
  const std::vector<BopModel> models = bop_models(workcell);
  write_bop_models(folder / "models", models);
  write_calibrations(workcell, options, folder);
  stop.expect(workcell.cameras.size());
  const std::vector<RecordedScene> scenes(workcell.cameras.size(),
                                          {&cell.scene, workcell.known_objects});
  return record_images(workcell.cameras, scenes, models, options, options.seed, folder, stop);
}

}  // namespace vantage
