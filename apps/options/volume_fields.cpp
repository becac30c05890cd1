#include "options/volume_fields.hpp"

namespace vantage {
namespace {

const EnumNames<OccluderMode> kOccluders{{"mesh", OccluderMode::mesh},
                                         {"voxels", OccluderMode::voxels}};

const EnumNames<FalseShadowFilter> kFilters{{"auto", FalseShadowFilter::automatic},
                                            {"off", FalseShadowFilter::off},
                                            {"on", FalseShadowFilter::on}};

}  // namespace

FieldGroup fields_of(StereoNoise& noise) {
  return {"noise",
          "",
          {{.key = "focal_px",
            .value = &noise.focal_px,
            .help = "Focal length of the stereo pair that measures depth",
            .unit = "px",
            .range = positive()},
           {.key = "baseline_m",
            .value = &noise.baseline_m,
            .help = "Distance between the stereo pair's imagers",
            .unit = "m",
            .range = positive()},
           {.key = "subpixel_px",
            .value = &noise.subpixel_px,
            .help = "Standard deviation of the depth cameras' stereo matching; 0: no noise",
            .option = "--depth-noise-px",
            .unit = "px",
            .range = not_negative()}}};
}

FieldGroup fields_of(VolumeOptions& volume) {
  return {"volume",
          "Work area",
          {{.key = "occluders",
            .value = choice(volume.occluders, kOccluders),
            .help = "Occluder geometry: the known objects' exact meshes, or the voxels that they "
                    "occupy, as in the thesis",
            .option = "--occluders",
            .expert = true},
           {.key = "anti_alias",
            .value = &volume.anti_alias,
            .help = "Turn shadow voxels with fewer than 5 of 6 neighbours in shadow free",
            .option = "--anti-alias",
            .fallback = "on with voxels as occluders, else off",
            .expert = true},
           {.key = "band_sigmas",
            .value = &volume.band_sigmas,
            .help = "Thickness of a measured surface in standard deviations of the depth; at least "
                    "one voxel",
            .option = "--band-sigmas",
            .unit = "sigmas",
            .range = not_negative(),
            .expert = true},
           {.key = "filter",
            .value = choice(volume.filter, kFilters),
            .help = "Treat thin shadow, which noise leaves along measured surfaces, as free before "
                    "planning; auto: if there are depth images with noise",
            .option = "--filter"},
           {.key = "filter_m",
            .value = &volume.filter_m,
            .help = "Shadow counts as thin where a cube of this edge length does not fit into it; "
                    "at least 3 voxels",
            .option = "--filter-edge",
            .unit = "m",
            .range = not_negative(),
            .expert = true}},
          {fields_of(volume.noise)}};
}

Field voxel_size_field(double& voxel_size_m) {
  return {.key = "voxel_size_m",
          .value = &voxel_size_m,
          .help = "Edge length of a voxel",
          .option = "--voxel-size",
          .unit = "m",
          .range = positive()};
}

}  // namespace vantage
