#include "plan/plan_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "options/field_json.hpp"
#include "options/unused_options.hpp"
#include "options/volume_fields.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/volume/plausibility.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

PlanRequest plan_request(const Workcell& workcell, const Intrinsics& usual) {
  PlanRequest request{.work_area = workcell.work_area,
                      .intrinsics = workcell.movable_intrinsics.value_or(usual),
                      .range = workcell.movable_range};
  request.candidates = workcell.candidates;
  request.constraints = workcell.constraints;
  request.volume = workcell.volume;
  request.voxel_size_m = workcell.voxel_size_m;
  workcell.plan.apply(request);
  return request;
}

namespace {

bool has_rings(const CandidateSet& set) {
  if (const auto* spheres = std::get_if<HalfSpheres>(&set)) return spheres->fan.rings > 0;
  const auto* grid = std::get_if<BoxGrid>(&set);
  return grid == nullptr || grid->fan.rings > 0;  // other kinds have no such option at all
}

/// What is computed with larger numbers is infinite, somewhere.
void check_extent(const Box& area, const std::string& where) {
  constexpr double kFarthest_m = 1e9;
  for (const Eigen::Vector3d& corner : {area.min(), area.max()}) {
    if (corner.cwiseAbs().maxCoeff() <= kFarthest_m) continue;
    throw bad_input(where, fmt::format("found a corner at ({:g}, {:g}, {:g}) m; expected "
                                       "coordinates of at most {:g}",
                                       corner.x(), corner.y(), corner.z(), kFarthest_m));
  }
}

/// The workcell file with the command line's options over it.
Workcell workcell_of(const PlanOptions& options) {
  std::optional<Box> area;
  if (!options.work_area.empty()) {
    const double* c = options.work_area.data();
    area.emplace(Eigen::Vector3d(c[0], c[1], c[2]), Eigen::Vector3d(c[3], c[4], c[5]),
                 "--work-area");
  }
  Workcell workcell = options.workcell.empty() ? Workcell{.work_area = area.value()}
                                               : load_workcell(options.workcell);
  if (area) workcell.work_area = *area;
  check_extent(workcell.work_area,
               area ? "--work-area" : options.workcell.string() + ": work_area");
  read_given(options.given, {"",
                             "",
                             {voxel_size_field(workcell.voxel_size_m)},
                             {fields_of(workcell.volume), fields_of(workcell.plan)}});
  options.candidates.apply(workcell);
  if (options.refuse_unused) {
    refuse_unused_fields(options.given, workcell.plan, workcell.volume);
    refuse_unused(options.candidates.given.contains("candidates") &&
                      options.candidates.given["candidates"].contains("ring_step_rad"),
                  has_rings(workcell.candidates), "--ring-step", "--rings N");
  }
  if (!options.depth_range.empty()) {
    const DepthRange range{options.depth_range[0], options.depth_range[1]};
    range.check("--depth-range");
    workcell.sensor_range = workcell.movable_range = range;
  }
  return workcell;
}

/// Depths so large, or noise so strong, that measurements do not tell where surfaces are.
void warn_of_thick_surfaces(const Workcell& workcell, const WorldModel& world,
                            std::vector<std::string>& warnings) {
  const Box& area = workcell.work_area;
  const double side_m = area.size().maxCoeff();
  double farthest_m = 0;
  for (const DepthCamera& camera : world.cameras) {
    if (camera.depth == nullptr) continue;
    farthest_m = std::max(farthest_m, (camera.camera.centre() - area.centre()).norm() + side_m);
  }
  const double depth_m = std::min(farthest_m, workcell.sensor_range.far_m);
  const double band_m = workcell.volume.band_sigmas * workcell.volume.noise.sigma_m(depth_m);
  if (band_m < 1 || band_m < 0.5 * side_m) return;
  warnings.push_back(
      fmt::format("at depths of {:.0f} m, noise makes measured surfaces {:.0f} m thick, in a work "
                  "area of {:.0f} m: check the depth range and the units of depth and work area, "
                  "or describe the sensor with volume: {{noise: …}}",
                  depth_m, band_m, side_m));
}

}  // namespace

PlanInput load_plan_input(const PlanOptions& options, const StopToken& stop) {
  const auto start = std::chrono::steady_clock::now();
  const Workcell workcell = workcell_of(options);
  PlanWorld plan =
      load_plan_world(options.dataset, options.images, workcell, options.objects, stop);
  for (std::string& finding :
       implausibilities(plan.world, workcell.work_area, workcell.voxel_size_m)) {
    plan.warnings.push_back(std::move(finding));
  }
  warn_of_thick_surfaces(workcell, plan.world, plan.warnings);
  const std::optional<double> floor_z_m = workcell.constraints.floor_z_m;
  if (floor_z_m && workcell.work_area.max().z() <= *floor_z_m) {
    plan.warnings.push_back(
        fmt::format("the work area lies below the floor, z = {:g} m, where no camera may be: check "
                    "the work area, or set floor_z_m (--floor-z)",
                    *floor_z_m));
  }
  PlanInput input{
      std::move(plan.world), plan_request(workcell, plan.first_camera), {}, plan.warnings};
  input.mesh = workcell.plan.mesh_method();
  input.record.warnings = plan.warnings;
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
