#include "evaluate/planning/planning_options.hpp"

#include "cli/number_checks.hpp"
#include "evaluate/planning/planning_cell.hpp"

namespace vantage {
namespace {

void add_input_options(CLI::App& verb, PlanningCommandOptions& options) {
  verb.add_option("scenes", options.scenes,
                  "Workcell files, each with the cameras to use and the depth images that planning "
                  "gets: FILE[:CAMERA,...][+none|+ideal|+noisy], e.g. wall.yaml:front "
                  "corridor.yaml:left,right foreign_objects.yaml+ideal")
      ->required();
  verb.add_option("--depth", options.depth,
                  "Depth images of scenes that do not say: none (known objects alone, as the "
                  "thesis' methods), ideal, or the workcell's noisy sensor")
      ->check(CLI::IsMember(kDepthKinds))
      ->capture_default_str();
  verb.add_option("--seed", options.seed, "Of the depth images' noise")->capture_default_str();
}

void add_method_options(CLI::App& verb, PlanningCommandOptions& options) {
  verb.add_option(
          "--methods", options.methods,
          "Methods, e.g. voxel,shadowD6,mesh,light; D and a number is the power of the depth. "
          "voxel is always there: it is the measure")
      ->delimiter(',')
      ->capture_default_str();
  verb.add_option("--candidates", options.sets,
                  "Sets of views: full (34,225), production (40), or both")
      ->delimiter(',')
      ->check(CLI::IsMember({"full", "production"}))
      ->capture_default_str();
  verb.add_option("--radii", options.benchmark.radii_m,
                  "Radii of the full set's three half-spheres, metres, e.g. 0.5,0.7,0.9; the "
                  "production set has the first and the last (default: from the work area)")
      ->delimiter(',')
      ->expected(3)
      ->check(positive_number());
  verb.add_option("--servo", options.benchmark.servo.iterations, "Servo iterations; 0: none")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  verb.add_option(
          "--polish", options.benchmark.polish.views,
          "So many of a method's best views are moved around the shadow and turned, as long "
          "as that makes them better; 0: none, as in the thesis")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  verb.add_option("--voxel-size", options.benchmark.voxel_size_m,
                  "Edge of a voxel, metres (default: the workcell's, else 0.009375)")
      ->check(positive_number());
  verb.add_option("--occluders", options.occluders,
                  "What hides: the known objects' exact meshes, or as in the thesis their voxels, "
                  "with anti-aliasing (default: the workcell's)")
      ->check(CLI::IsMember({"mesh", "voxels"}));
  verb.add_option("--repeat", options.benchmark.repeat,
                  "Time everything so often; run times are medians")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

void add_output_options(CLI::App& verb, PlanningCommandOptions& options) {
  verb.add_option("-o,--output", options.folder,
                  "Folder for planning.html, planning.json and charts as SVG");
  verb.add_flag("--no-pictures", options.no_pictures, "A page without pictures of the scenes");
  verb.add_flag("--json", options.json, "Print planning.json instead of tables");
  verb.add_option("--threads", options.threads, "Threads to use (0: all)")
      ->check(CLI::Range(0, 1024));
}

}  // namespace

void PlanningCommandOptions::add_to(CLI::App& verb) {
  add_input_options(verb, *this);
  add_method_options(verb, *this);
  add_output_options(verb, *this);
}

}  // namespace vantage
