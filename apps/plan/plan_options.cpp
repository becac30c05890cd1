#include "plan/plan_options.hpp"

#include "cli/shared_options.hpp"
#include "options/command_line.hpp"
#include "options/volume_fields.hpp"

namespace vantage {

void add_input_options(CLI::App& verb, PlanOptions& plan) {
  verb.add_option("dataset", plan.dataset, "BOP scene folder: scene_camera.json, depth/, rgb/")
      ->required();
  CLI::Option* workcell =
      verb.add_option("--workcell", plan.workcell,
                      "Workcell file (YAML); options on the command line override it")
          ->option_text("FILE")
          ->group("Input");
  add_images_option(verb, plan.images);
  verb.add_option("--depth-range", plan.depth_range,
                  "The depths that the cameras can measure, metres")
      ->option_text("NEAR FAR")
      ->expected(2)
      ->group("Input");
  CLI::Option* area =
      verb.add_option("--work-area", plan.work_area,
                      "The box to look into: its lower and upper corner, metres, world frame")
          ->option_text("X0 Y0 Z0 X1 Y1 Z1")
          ->expected(6)
          ->group("Work area");
  verb.callback([=, &verb] {
    if (workcell->count() + area->count() == 0) {
      throw CLI::ValidationError(verb.get_name(),
                                 "give --workcell FILE or --work-area X0 Y0 Z0 X1 Y1 Z1: "
                                 "which volume matters is not in the dataset");
    }
  });
}

void add_object_options(CLI::App& verb, ObjectSource& source) {
  verb.add_option("--objects", source.objects,
                  "given: the workcell's known_objects; pnp, voting, svd: found by that method; "
                  "given+pnp: both; or a world.json of `vantage reconstruct` (default: given if "
                  "there are any, else "
                  "pnp)")
      ->option_text("given|pnp|voting|svd|given+pnp|FILE")
      ->group("Known objects");
  source.how.add_to(verb);
  source.how.add_depth_lens_to(verb);
}

void add_volume_options(CLI::App& verb, PlanOptions& plan) {
  Workcell defaults{.work_area = Box({0, 0, 0}, {1, 1, 1})};
  const FieldGroup all{
      "", "Work area", {voxel_size_field(defaults.voxel_size_m)}, {fields_of(defaults.volume)}};
  add_fields(verb, all, plan.given);
}

}  // namespace vantage
