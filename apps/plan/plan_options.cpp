#include "plan/plan_options.hpp"

#include "cli/number_checks.hpp"

namespace vantage {

void add_input_options(CLI::App& verb, PlanOptions& plan) {
  verb.add_option("dataset", plan.dataset, "BOP scene folder: scene_camera.json, depth/, rgb/")
      ->required();
  CLI::Option* workcell = verb.add_option("--workcell", plan.workcell,
                                          "Workcell file (YAML); options given here win over it");
  CLI::Option* area =
      verb.add_option("--work-area", plan.work_area,
                      "The box to look into: X0 Y0 Z0 X1 Y1 Z1, metres, world frame")
          ->expected(6);
  verb.add_option("--images", plan.images, "Use these images of the dataset only, e.g. 0,20,40")
      ->delimiter(',');
  verb.add_option("--depth-range", plan.depth_range,
                  "NEAR FAR: depths that the cameras measure, metres")
      ->expected(2);
  verb.callback([=, &verb] {
    if (workcell->count() + area->count() == 0) {
      throw CLI::ValidationError(verb.get_name(),
                                 "give --workcell FILE or --work-area X0 Y0 Z0 X1 Y1 Z1: "
                                 "which volume matters is not in the dataset");
    }
  });
}

void add_object_options(CLI::App& verb, ObjectSource& source) {
  verb.add_option(
      "--objects", source.objects,
      "given: the workcell's known_objects; pnp, voting, svd: found by that method; or "
      "a world.json of `vantage reconstruct` (default: given if there are any, else pnp)");
  source.how.add_to(verb);
}

void add_volume_options(CLI::App& verb, PlanOptions& plan) {
  verb.add_option("--voxel-size", plan.voxel_size_m, "Edge of a voxel, metres (default: 0.009375)");
  verb.add_option("--occluders", plan.occluders,
                  "What hides from a camera: the known objects' exact meshes, or their voxels "
                  "(default: mesh)")
      ->check(CLI::IsMember({"mesh", "voxels"}));
  verb.add_option("--anti-alias", plan.anti_alias,
                  "Free shadow voxels with fewer than 5 of 6 neighbours in shadow "
                  "(default: on with --occluders voxels)")
      ->check(CLI::IsMember({"on", "off"}));
  verb.add_option("--band-sigmas", plan.band_sigmas,
                  "Thickness of a measured surface in standard deviations of the depth, at least a "
                  "voxel (default: 4)")
      ->check(number_from_zero());
  verb.add_option("--depth-noise-px", plan.depth_noise_px,
                  "Noise of the depth cameras' stereo matching, pixels (default: 0.08)")
      ->check(number_from_zero());
}

}  // namespace vantage
