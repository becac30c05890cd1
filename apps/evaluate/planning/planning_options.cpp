#include "evaluate/planning/planning_options.hpp"

#include "cli/number_checks.hpp"
#include "cli/shared_options.hpp"
#include "evaluate/planning/planning_cell.hpp"
#include "options/command_line.hpp"
#include "options/view_options.hpp"
#include "options/volume_fields.hpp"
#include "workcell/workcell.hpp"

namespace vantage {
namespace {

void add_input_options(CLI::App& verb, PlanningCommandOptions& options) {
  verb.add_option("scenes", options.scenes,
                  "Workcell files, each with the cameras to use and the depth images that planning "
                  "gets: FILE[:CAMERA,...][+none|+ideal|+noisy], e.g. wall.yaml:front "
                  "corridor.yaml:left,right foreign_objects.yaml+ideal")
      ->required();
  verb.add_option("--depth", options.depth,
                  "Depth images for scenes that do not name theirs; none: known objects only, as "
                  "in the thesis; ideal; noisy: the workcell's sensor")
      ->check(CLI::IsMember(kDepthKinds))
      ->capture_default_str();
  verb.add_option("--seed", options.seed, "Random seed for the depth images' noise")
      ->capture_default_str();
}

void add_method_options(CLI::App& verb, PlanningCommandOptions& options) {
  double voxel_size_m = Workcell{.work_area = Box({0, 0, 0}, {1, 1, 1})}.voxel_size_m;
  ServoOptions servo;
  PolishOptions polish;
  VolumeOptions volume;
  verb.add_option("--methods", options.methods,
                  "Methods, e.g. voxel,expected,shadowD6,mesh,light; D and a number set the depth "
                  "power. voxel is always included, because the others are measured by it")
      ->delimiter(',')
      ->capture_default_str();
  verb.add_option(
          "--value", options.value,
          "bound: method voxel scores by all shadow in a view's line of sight, as in the thesis; "
          "expected: picks by the expected gain are compared as well, as method expected")
      ->check(CLI::IsMember({"bound", "expected"}))
      ->capture_default_str();
  verb.add_option("--candidates", options.sets,
                  "Sets of views: full (34,225), production (40), or both")
      ->delimiter(',')
      ->check(CLI::IsMember({"full", "production"}))
      ->capture_default_str();
  verb.add_option("--radii", options.benchmark.radii_m,
                  "Radii of the full set's three half-spheres, metres, e.g. 0.5,0.7,0.9; the "
                  "production set uses the first and the last (default: from the work area)")
      ->delimiter(',')
      ->expected(3)
      ->check(positive_number());
  add_fields(verb,
             {"",
              "Method",
              {voxel_size_field(voxel_size_m)},
              {fields_of(servo), fields_of(polish), fields_of(volume)}},
             options.given);
  verb.add_option("--repeat", options.benchmark.repeat,
                  "Number of timed repetitions, whose medians are reported")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

void add_output_options(CLI::App& verb, PlanningCommandOptions& options) {
  CLI::Option* folder =
      add_output_option(verb, options.folder, "planning.html, planning.json and charts as SVG");
  verb.add_flag("--no-pictures", options.no_pictures, "Leave the scenes' pictures out of the page")
      ->needs(folder)
      ->group("Output");
  add_json_flag(verb, options.json, "planning.json");
  add_threads_option(verb, options.threads);
}

}  // namespace

void PlanningCommandOptions::add_to(CLI::App& verb) {
  add_input_options(verb, *this);
  add_method_options(verb, *this);
  add_output_options(verb, *this);
}

}  // namespace vantage
