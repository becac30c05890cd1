#include "plan/plan_input.hpp"

#include <chrono>

#include "vantage/raycore/error.hpp"
#include "workcell/volume_settings.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

PlanRequest plan_request(const Workcell& workcell, const Intrinsics& usual) {
  PlanRequest request{.work_area = workcell.work_area,
                      .intrinsics = workcell.movable_intrinsics.value_or(usual),
                      .range = workcell.movable_range};
  request.candidates = workcell.candidates;
  request.constraints = workcell.constraints;
  request.volume = workcell.volume;
  if (workcell.voxel_size_m) request.voxel_size_m = *workcell.voxel_size_m;
  return request;
}

namespace {

/// The workcell file with the command line's settings on top.
Workcell workcell_of(const PlanOptions& options) {
  std::optional<Box> area;
  if (!options.work_area.empty()) {
    const double* c = options.work_area.data();
    area.emplace(Eigen::Vector3d(c[0], c[1], c[2]), Eigen::Vector3d(c[3], c[4], c[5]),
                 "--work-area");
  }
  if (options.workcell.empty()) return {.work_area = area.value()};
  Workcell workcell = load_workcell(options.workcell);
  if (area) workcell.work_area = *area;
  return workcell;
}

VolumeOptions volume_of(const Workcell& workcell, const PlanOptions& options) {
  VolumeOptions volume = workcell.volume;
  if (!options.occluders.empty()) volume.occluders = occluder_mode_of(options.occluders);
  if (!options.anti_alias.empty()) volume.anti_alias = options.anti_alias == "on";
  if (options.band_sigmas) volume.band_sigmas = *options.band_sigmas;
  if (options.depth_noise_px) volume.noise.subpixel_px = *options.depth_noise_px;
  return volume;
}

PlanRequest request_of(const Workcell& workcell, const PlanOptions& options,
                       const Intrinsics& first_camera) {
  PlanRequest request = plan_request(workcell, first_camera);
  request.volume = volume_of(workcell, options);
  if (options.voxel_size_m) request.voxel_size_m = *options.voxel_size_m;
  return request;
}

}  // namespace

PlanInput load_plan_input(const PlanOptions& options, const StopToken& stop) {
  const auto start = std::chrono::steady_clock::now();
  Workcell workcell = workcell_of(options);
  options.candidates.apply(workcell);
  if (!options.depth_range.empty()) {
    const DepthRange range{options.depth_range[0], options.depth_range[1]};
    range.check("--depth-range");
    workcell.sensor_range = workcell.movable_range = range;
  }
  PlanWorld plan =
      load_plan_world(options.dataset, options.images, workcell, options.objects, stop);
  PlanInput input{
      std::move(plan.world), request_of(workcell, options, plan.first_camera), {}, plan.warnings};
  input.record.inputs = workcell.files;
  input.record.inputs.insert(input.record.inputs.end(), plan.files.begin(), plan.files.end());
  input.record.config = {
      {"dataset", options.dataset.string()},
      {"workcell", options.workcell.empty() ? nlohmann::ordered_json()
                                            : nlohmann::ordered_json(options.workcell.string())},
      {"images", options.images},
      {"objects", plan.objects},
      {"sensor_depth_range_m", {workcell.sensor_range.near_m, workcell.sensor_range.far_m}}};
  input.record.load_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return input;
}

}  // namespace vantage
