#include "options/candidate_fields.hpp"

#include <numbers>

namespace vantage {
namespace {

constexpr const char* kHeading = "Candidates";

FieldGroup fan_fields(ViewFan& fan) {
  return {
      "",
      kHeading,
      {{.key = "rings",
        .value = &fan.rings,
        .help =
            "Rings of additional directions at each position: 8 in the first, 16 in the second …",
        .option = "--rings",
        .range = from_to(0, 50)},
       {.key = "ring_step_rad",
        .value = &fan.step_rad,
        .help = "Angle between rings",
        .option = "--ring-step",
        .unit = "rad",
        .range = from_to(1e-6, std::numbers::pi)}}};
}

}  // namespace

FieldGroup fields_of(HalfSpheres& spheres) {
  return {"candidates",
          kHeading,
          {{.key = "radii_m",
            .value = &spheres.radii_m,
            .help = "Radii of the half-spheres, e.g. 0.6,0.9",
            .option = "--radii",
            .unit = "m",
            .range = positive(),
            .fallback = "from the work area's size"},
           {.key = "count",
            .value = &spheres.counts,
            .help = "Positions on each half-sphere: one number, or one for each, e.g. 20,40",
            .option = "--count",
            .range = from_to(1, 1000000),
            .fallback = "the set's"}},
          {fan_fields(spheres.fan)}};
}

FieldGroup fields_of(BoxGrid& grid) {
  return {"candidates", kHeading, {}, {fan_fields(grid.fan)}};
}

FieldGroup fields_of(AroundPath& around) {
  return {"candidates",
          kHeading,
          {{.key = "step_m",
            .value = &around.step_m,
            .help = "Distance between poses along the path",
            .unit = "m",
            .range = positive()},
           {.key = "radius_m",
            .value = &around.radius_m,
            .help = "Radius of the sphere around each of these poses that further poses lie on",
            .unit = "m",
            .range = positive()},
           {.key = "count",
            .value = &around.count,
            .help = "Poses on each sphere",
            .range = from_to(1, 1000000)}}};
}

FieldGroup fields_of(ViewList&) {
  return {"candidates", kHeading, {}};
}

FieldGroup fields_of(CandidateSet& set) {
  return std::visit([](auto& kind) { return fields_of(kind); }, set);
}

Field clearance_field(ViewConstraints& constraints) {
  return {.key = "clearance_m",
          .value = &constraints.clearance_m,
          .help = "Minimum distance of the camera's body from the floor and from occupied volume",
          .option = "--clearance",
          .unit = "m",
          .range = not_negative()};
}

Field floor_field(ViewConstraints& constraints) {
  return {.key = "floor_z_m",
          .value = &constraints.floor_z_m,
          .help = "Height of the floor, which the camera must stay above; none: no floor",
          .option = "--floor-z",
          .unit = "Z",
          .none = "none"};
}

Field camera_body_field(ViewConstraints& constraints) {
  Choice body{{"d435", "none"}, {}, {}};
  body.get = [&constraints]() -> std::string {
    if (std::holds_alternative<std::monostate>(constraints.body)) return "none";
    const BoxBody *box = std::get_if<BoxBody>(&constraints.body), usual = d435_body();
    const bool same =
        box != nullptr && box->box.min() == usual.box.min() && box->box.max() == usual.box.max();
    return same ? "d435" : "";
  };
  body.set = [&constraints](const std::string& name) {
    constraints.body = name == "none" ? CameraBody() : CameraBody(d435_body());
  };
  return {
      .key = "camera_body",
      .value = body,
      .help =
          "Housing of the movable camera, which must not enter occupied or unseen volume; d435: a "
          "RealSense D435's, 90 x 25 x 25 mm; none: only the camera's centre is checked",
      .option = "--camera-body"};
}

FieldGroup body_fields(ViewConstraints& constraints) {
  return {"",
          kHeading,
          {camera_body_field(constraints), clearance_field(constraints), floor_field(constraints)}};
}

}  // namespace vantage
