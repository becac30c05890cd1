#include "options/sensor_fields.hpp"

#include <numbers>

#include "options/volume_fields.hpp"

namespace vantage {
namespace {

std::vector<Field> effects_of(StereoSensor& depth) {
  return {{.key = "disparity_step_px",
           .value = &depth.disparity_step_px,
           .help = "Quantisation step of the disparity; 0: none",
           .option = "--disparity-step-px",
           .unit = "px",
           .range = not_negative(),
           .expert = true},
          {.key = "max_disparity_px",
           .value = &depth.max_disparity_px,
           .help = "Search range of the disparity: nearer surfaces get no depth; 0: no limit",
           .option = "--max-disparity-px",
           .unit = "px",
           .range = not_negative(),
           .expert = true},
          {.key = "second_imager",
           .value = &depth.second_imager,
           .help = "No depth where the second imager cannot see the surface"},
          {.key = "projector",
           .value = &depth.projector,
           .help = "No depth where the projector's light does not reach the surface"},
          {.key = "projector_m",
           .value = &depth.projector_m,
           .help = "Position of the projector, from the first imager towards the second",
           .unit = "m"},
          {.key = "max_incidence_rad",
           .value = &depth.max_incidence_rad,
           .help = "Largest angle between a surface's normal and the ray that still gets a depth",
           .unit = "rad",
           .range = from_to(0, std::numbers::pi / 2)},
          {.key = "border_px",
           .value = &depth.border_px,
           .help = "Width of the image's border without depth",
           .option = "--border-px",
           .unit = "px",
           .range = from_to(0, 16384),
           .expert = true},
          {.key = "flying_pixels",
           .value = &depth.flying_pixels,
           .help = "Share of the pixels at a depth discontinuity that get a depth in between "
                   "(flying pixels)",
           .option = "--flying-pixels",
           .range = from_to(0, 1)}};
}

}  // namespace

FieldGroup fields_of(ColorSensor& color) {
  return {"color",
          "Colour images",
          {{.key = "samples_per_pixel",
            .value = &color.samples_per_pixel,
            .help = "Rays per pixel of a colour image",
            .option = "--samples",
            .range = from_to(1, 4096)},
           {.key = "vignetting",
            .value = &color.vignetting,
            .help = "Vignetting; 0: none; 1: the cos^4 law",
            .option = "--vignetting",
            .range = from_to(0, 1)},
           {.key = "read_noise",
            .value = &color.read_noise,
            .help = "Standard deviation of the linear signal, whose full scale is 1",
            .option = "--read-noise",
            .range = from_to(0, 1)},
           {.key = "shot_noise",
            .value = &color.shot_noise,
            .help = "Variance per unit of the linear signal",
            .option = "--shot-noise",
            .range = from_to(0, 1)}}};
}

FieldGroup fields_of(StereoSensor& depth) {
  FieldGroup group{"depth", "Depth images", fields_of(depth.noise).fields};
  for (Field& field : effects_of(depth)) group.fields.push_back(std::move(field));
  return group;
}

Field depth_scale_field(double& depth_scale_mm) {
  return {.key = "depth_scale_mm",
          .value = &depth_scale_mm,
          .help = "Millimetres per count of the depth images",
          .option = "--depth-scale-mm",
          .unit = "mm",
          .range = from_to(1e-3, 100),
          .expert = true};
}

}  // namespace vantage
