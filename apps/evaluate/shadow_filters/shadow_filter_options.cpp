#include "evaluate/shadow_filters/shadow_filter_options.hpp"

#include "cli/shared_options.hpp"
#include "options/command_line.hpp"
#include "options/field_json.hpp"
#include "options/unused_options.hpp"
#include "options/volume_fields.hpp"

namespace vantage {
namespace {

const EnumNames<DepthHoles> kFilterHoles{{"fill", DepthHoles::fill},
                                         {"unknown", DepthHoles::unknown}};

FieldGroup filter_fields(ShadowFilterOptions& settings) {
  return {"",
          "Filters",
          {{.key = "offsets_sigmas",
            .value = &settings.offsets_sigmas,
            .help = "Offsets of the visibility mesh away from its camera, in standard deviations "
                    "of the depth",
            .option = "--offsets",
            .unit = "sigmas",
            .range = from_to(0, 1000)},
           {.key = "openings_voxels",
            .value = &settings.openings_voxels,
            .help = "Radii of the shadow's morphological opening; 0: no opening",
            .option = "--openings",
            .unit = "voxels",
            .range = from_to(0, 64)},
           {.key = "least_cm3",
            .value = &settings.min_cm3,
            .help = "Minimum volumes of a connected component of shadow voxels: smaller ones are "
                    "removed; 0: none",
            .option = "--least-cm3",
            .unit = "cm3",
            .range = from_to(0, 1e9)}}};
}

FieldGroup grid_fields(ShadowFilterOptions& settings) {
  return {"",
          "Grid",
          {{.key = "classified",
            .value = &settings.classified,
            .help = "Filter the voxels as planning classifies them, instead of carving the work "
                    "area by visibility meshes",
            .option = "--classified",
            .flag = true},
           {.key = "step_px",
            .value = &settings.step_px,
            .help = "Spacing of the visibility mesh's vertices in the depth images",
            .option = "--step",
            .unit = "px",
            .range = from_to(1, 64)},
           {.key = "holes",
            .value = choice(settings.holes, kFilterHoles),
            .help = "Pixels without a depth; fill: interpolated from the depths around them; "
                    "unknown: they stay shadow",
            .option = "--holes"},
           voxel_size_field(settings.voxel_size_m)}};
}

FieldGroup fields_of(ShadowFilterCommandOptions& options) {
  return {"",
          "Input",
          {{.key = "seed",
            .value = &options.seed,
            .help = "Random seed for the depth images' noise",
            .option = "--seed"}},
          {filter_fields(options.settings), grid_fields(options.settings)}};
}

}  // namespace

void ShadowFilterCommandOptions::add_to(CLI::App& verb) {
  verb.add_option("scenes", scenes,
                  "Workcell files, each with the cameras to use and their depth images: "
                  "FILE[:CAMERA,...][+ideal|+noisy], e.g. wall.yaml:side (default: noisy)")
      ->required();
  add_fields(verb, fields_of(*this), given);
  add_json_flag(verb, json, "JSON");
  add_threads_option(verb, threads);
}

void ShadowFilterCommandOptions::resolve() {
  read_given(given, fields_of(*this));
  for (const auto& [key, option] :
       {std::pair("offsets_sigmas", "--offsets"), std::pair("step_px", "--step"),
        std::pair("holes", "--holes")}) {
    refuse_useless(given.contains(key), settings.classified, option, "--classified");
  }
}

nlohmann::ordered_json ShadowFilterCommandOptions::config() const {
  nlohmann::ordered_json result{{"scenes", scenes}};
  ShadowFilterCommandOptions described = *this;
  result.update(to_json(fields_of(described)));
  return result;
}

}  // namespace vantage
