#include "options/view_options.hpp"

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

const EnumNames<MeshWeight> kWeights{{"depth", MeshWeight::depth}, {"volume", MeshWeight::volume}};
const EnumNames<DepthHoles> kHoles{{"fill", DepthHoles::fill}, {"unknown", DepthHoles::unknown}};

Field method_field(std::string& method) {
  return {.key = "method",
          .value = Choice{method_names(), [&method] { return method; },
                          [&method](const std::string& name) { method = name; }},
          .help =
              "How views are scored; voxel: by the volume that a view would reveal; shadow: by the "
              "shadow in its image, weighted by depth; mesh: by the volume that no depth image "
              "shows, with or without known objects; light: by the unlit surface that it would "
              "light, for comparison",
          .option = "--method"};
}

Field depth_power_field(ViewOptions& options) {
  return {.key = "depth_power",
          .value = &options.depth_power,
          .help =
              "Exponent P of shadow and mesh: a pixel counts depth^P; 0, 3 and 6 are the "
              "thesis' D0, D3 and D6",
          .option = "--depth-power",
          .range = from_to(0, 16),
          .fallback = "6"};
}

/// Not set by itself: whether a depth power is given decides then.
Field mesh_weight_field(ViewOptions& options) {
  Choice weight{{"depth", "volume"}, {}, {}};
  weight.get = [&options] {
    if (!options.mesh_weight) return std::string();
    return choice(*options.mesh_weight, kWeights).get();
  };
  weight.set = [&options](const std::string& name) {
    options.mesh_weight = name == "depth" ? MeshWeight::depth : MeshWeight::volume;
  };
  return {.key = "weight",
          .value = weight,
          .help =
              "Weight of an unseen pixel; volume: the volume behind it, which makes views from "
              "different distances comparable; depth: depth^P, as in the thesis",
          .option = "--mesh-weight",
          .fallback = "volume, or depth if --depth-power is given",
          .expert = true};
}

const EnumNames<ViewValue> kValues{{"expected", ViewValue::expected}, {"bound", ViewValue::bound}};

Field sensor_field(ViewOptions& options) {
  return {.key = "sensor",
          .value = Choice{
              {"stereo", "ideal"},
              [&options] { return options.ideal_sensor ? "ideal" : "stereo"; },
              [&options](const std::string& name) { options.ideal_sensor = name == "ideal"; }},
          .help =
              "How the movable camera measures depth; stereo: as movable_camera.depth says, or "
              "like a RealSense D435; ideal: everything in its line of sight",
          .option = "--sensor"};
}

FieldGroup search_fields(ViewOptions& options) {
  return {"",
          "View search",
          {{.key = "ranked",
            .value = &options.ranked,
            .help = "Number of exactly ranked top candidates",
            .option = "--ranked",
            .range = from_to(1, 1000000),
            .expert = true}}};
}

FieldGroup travel_fields(ViewOptions& options) {
  return {"travel",
          "View search",
          {{.key = "from_m",
            .value = &options.from_m,
            .help = "Where the camera is now, in the world frame, metres",
            .option = "--from"},
           {.key = "weight_per_m",
            .value = &options.travel_weight_per_m,
            .help = "Travel cost W: a score is multiplied by exp(-W d) at distance d from --from",
            .option = "--travel-weight",
            .unit = "1/m",
            .range = not_negative()}}};
}

}  // namespace

FieldGroup expected_gain_fields(ViewOptions& options) {
  return {"",
          "Method",
          {{.key = "value",
            .value = choice(options.value, kValues),
            .help = "What method voxel scores views by; expected: the volume that the movable "
                    "camera is expected to turn from shadow to free or occupied; bound: all shadow "
                    "in its line of sight, as in the thesis",
            .option = "--value"},
           sensor_field(options),
           {.key = "unknown_depth",
            .value = &options.unknown_depth,
            .help = "Assumed depth of unknown objects whose front was measured, in multiples of "
                    "their visible width; 0: there are no unknown objects",
            .option = "--unknown-depth",
            .range = not_negative(),
            .expert = true}}};
}

FieldGroup fields_of(ServoOptions& servo) {
  return {"servo",
          "Servoing",
          {{.key = "iterations",
            .value = &servo.iterations,
            .help = "Iterations of simulated visual servoing for each candidate; 0: none",
            .option = "--servo",
            .range = from_to(0, 100)},
           {.key = "image_width",
            .value = &servo.image_width,
            .help = "Width of the images for servoing",
            .option = "--servo-width",
            .unit = "px",
            .range = from_to(16, 16384),
            .expert = true}}};
}

FieldGroup fields_of(PolishOptions& polish) {
  return {"polish",
          "Servoing",
          {{.key = "views",
            .value = &polish.views,
            .help = "Number of top views that a local pattern search improves further; 0: none",
            .option = "--polish",
            .range = from_to(0, 1000)},
           {.key = "image_width",
            .value = &polish.image_width,
            .help = "Width of the images that the pattern search scores views by",
            .unit = "px",
            .range = from_to(16, 16384)}}};
}

FieldGroup fields_of(MeshMethod& mesh) {
  VisibilityOptions& visibility = mesh.visibility;
  return {
      "mesh",
      "Method mesh",
      {{.key = "step_px",
        .value = &visibility.step_px,
        .help = "Spacing of the visibility mesh's vertices in the depth images",
        .option = "--mesh-step",
        .unit = "px",
        .range = from_to(1, 64),
        .expert = true},
       {.key = "holes",
        .value = choice(visibility.holes, kHoles),
        .help = "Pixels without a depth; fill: interpolated from the depths around them; unknown: "
                "they stay shadow",
        .option = "--mesh-holes",
        .expert = true},
       {.key = "fill_reach_px",
        .value = &visibility.fill_reach_px,
        .help = "Greatest distance from a measured pixel to one that is filled in",
        .unit = "px",
        .range = from_to(0, 16384)},
       {.key = "offset_sigmas",
        .value = &visibility.offset_sigmas,
        .help = "Offset of measured surfaces away from the camera, in standard deviations of the "
                "depth: removes the false shadow that noise makes",
        .option = "--mesh-offset",
        .unit = "sigmas",
        .range = from_to(0, 100),
        .expert = true},
       {.key = "opening_m",
        .value = &mesh.opening_m,
        .help = "Edge of the cube for the morphological opening of the unseen volume: thinner "
                "parts count as seen, because noise makes them, too; 0: no opening",
        .option = "--mesh-opening",
        .unit = "m",
        .range = not_negative(),
        .expert = true},
       {.key = "enlarge",
        .value = &mesh.enlarge,
        .help = "Scale factor of known objects, for imprecise models and poses",
        .range = from_to(1, 10)},
       {.key = "image_width",
        .value = &mesh.image_width,
        .help = "Width of the images that views are scored by",
        .unit = "px",
        .range = from_to(16, 16384)},
       {.key = "exact_views",
        .value = &mesh.exact_views,
        .help = "Number of views, servo iterations included, up to which all are scored exactly; "
                "if there are more, a proxy preselects a shortlist",
        .option = "--mesh-exact",
        .range = from_to(0, 2147483647),
        .expert = true},
       {.key = "shortlist",
        .value = &mesh.shortlist,
        .help = "Length of that shortlist",
        .option = "--mesh-shortlist",
        .range = from_to(1, 1000000),
        .expert = true},
       {.key = "shortlist_voxel_m",
        .value = &mesh.shortlist_voxel_m,
        .help = "Edge length of the voxels that the proxy scores in",
        .unit = "m",
        .range = positive()}}};
}

FieldGroup fields_of(ViewSequenceOptions& views) {
  return {"views",
          "View search",
          {{.key = "most",
            .value = &views.most,
            .help = "Number of views to plan, each for what the views before it left in shadow",
            .option = "--views",
            .range = from_to(1, 1000)},
           {.key = "least_gain_m3",
            .value = &views.min_gain_m3,
            .help = "Stop before a further view that would reveal less than this",
            .option = "--least-gain",
            .unit = "m3",
            .range = not_negative()},
           {.key = "least_gain_share",
            .value = &views.min_gain_share,
            .help = "The same, as a share of all shadow",
            .option = "--least-gain-share",
            .range = from_to(0, 1)}}};
}

FieldGroup fields_of(ViewOptions& options) {
  FieldGroup mesh = fields_of(options.mesh);
  mesh.fields.insert(mesh.fields.begin(), mesh_weight_field(options));
  return {"",
          "Method",
          {method_field(options.method), depth_power_field(options)},
          {expected_gain_fields(options), mesh, fields_of(options.servo), fields_of(options.polish),
           search_fields(options), travel_fields(options), fields_of(options.views)}};
}

MeshMethod ViewOptions::mesh_method() const {
  MeshMethod result = mesh;
  result.depth_power = depth_power.value_or(mesh.depth_power);
  result.weight = mesh_weight.value_or(depth_power ? MeshWeight::depth : mesh.weight);
  return result;
}

Method ViewOptions::chosen() const {
  const Method usual = method_named(method);
  if (std::holds_alternative<MeshMethod>(usual)) return mesh_method();
  if (std::holds_alternative<ShadowMethod>(usual) && depth_power) return ShadowMethod{*depth_power};
  return usual;
}

void ViewOptions::apply(PlanRequest& request) const {
  if (travel_weight_per_m > 0 && !from_m) {
    throw bad_input("travel",
                    "found a travel weight without a start position; expected both: give --from X "
                    "Y Z, or from_m next to weight_per_m");
  }
  request.method = chosen();
  request.value = value;
  request.gain = {ideal_sensor ? StereoSensor::ideal() : sensor, unknown_depth};
  request.servo = servo;
  request.polish = polish;
  request.search.ranked = ranked;
  if (from_m) request.search.travel = TravelCost{travel_weight_per_m, *from_m};
  request.views = views;
}

}  // namespace vantage
