#include "workcell/workcell_views.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "documents/value_readers.hpp"
#include "options/candidate_fields.hpp"
#include "options/field_json.hpp"
#include "workcell/npy_file.hpp"
#include "workcell/view_list.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

/// The keys that are there, of the different kinds of candidates.
void check_one_kind(const Value& value) {
  std::vector<std::string> spheres, others;
  for (const char* key : {"set", "radii_m", "count", "rings", "ring_step_rad"}) {
    if (value.has(key)) spheres.push_back(key);
  }
  for (const char* key : {"box_grid", "around_path", "views"}) {
    if (value.has(key)) others.push_back(key);
  }
  if (others.empty() || (others.size() == 1 && spheres.empty())) return;
  others.insert(others.end(), spheres.begin(), spheres.end());
  throw value.error(fmt::format(
      "found {}; expected half-spheres (set, radii_m, count, rings, ring_step_rad) or one of "
      "box_grid, around_path and views",
      fmt::join(others, ", ")));
}

HalfSpheres read_half_spheres(const Value& value) {
  HalfSpheres own;
  read_fields(value, fields_of(own));
  HalfSpheres spheres = half_spheres_of(value.get<std::string>("set", "production"), own.radii_m);
  read_fields(value, fields_of(spheres));
  return spheres;
}

BoxGrid read_box_grid(const Value& value) {
  const auto counts = value["counts"].as<std::vector<int>>();
  BoxGrid grid{read_box(value), {counts[0], counts[1], counts[2]}};
  read_fields(value, fields_of(grid));
  return grid;
}

AroundPath read_around_path(const Value& value, const fs::path& folder,
                            std::vector<fs::path>& files) {
  AroundPath around;
  around.path = read_views(value["path"], folder, files);
  read_fields(value, fields_of(around));
  return around;
}

Reach read_shell(const Value& value) {
  const Reach reach{value["base_m"].vector(), value.get("min_m", 0.0), value["max_m"].as<double>()};
  if (reach.min_m >= reach.max_m) {
    throw value.error(fmt::format("found min_m: {} and max_m: {}; expected min_m < max_m",
                                  reach.min_m, reach.max_m));
  }
  return reach;
}

std::shared_ptr<const ReachMap> read_map(const Value& value, const fs::path& folder,
                                         std::vector<fs::path>& files) {
  ByteArray3 cells = read_npy_bytes(named_file(value["file"], folder, files));
  ReachMap map{value["origin_m"].vector(), value["cell_m"].as<double>(), cells.shape,
               std::move(cells.values)};
  map.check(value.place());
  return std::make_shared<const ReachMap>(std::move(map));
}

void read_reach(const Value& value, const fs::path& folder, std::vector<fs::path>& files,
                ViewConstraints& limits) {
  if (value.has("base_m")) limits.reach = read_shell(value);
  if (value.has("shell")) limits.reach = read_shell(value["shell"]);
  if (value.has("box")) limits.reach_box = read_box(value["box"]);
  if (value.has("map")) limits.reach_map = read_map(value["map"], folder, files);
}

ViewCone read_cone(const Value& value) {
  ViewCone cone;
  if (value.has("axis")) cone.axis = value["axis"].vector();
  cone.half_angle_rad = value["half_angle_rad"].as<double>();
  cone.check(value.place());
  return cone;
}

/// A name, or a shape.
void read_body(const Value& value, ViewConstraints& limits) {
  if (value.is_string()) {
    std::get<Choice>(camera_body_field(limits).value).set(value.as<std::string>());
  }
  if (value.has("sphere")) limits.body = SphereBody{value["sphere"]["radius_m"].as<double>()};
  if (value.has("box")) limits.body = BoxBody{read_box(value["box"])};
}

}  // namespace

HalfSpheres half_spheres_of(std::string_view set, const std::vector<double>& radii_m) {
  HalfSpheres spheres = set == "full" ? full_views() : production_views();
  spheres.radii_m = radii_m;
  if (spheres.counts.size() == 1 || radii_m.empty()) return spheres;
  int total = 0;
  for (const int count : spheres.counts) total += count;
  spheres.counts.clear();
  for (int left = int(radii_m.size()); left > 0; --left) {
    spheres.counts.push_back(total / left);
    total -= spheres.counts.back();
  }
  return spheres;
}

CandidateSet read_candidates(const Value& value, const fs::path& folder,
                             std::vector<fs::path>& files) {
  check_one_kind(value);
  if (value.has("box_grid")) return read_box_grid(value["box_grid"]);
  if (value.has("around_path")) return read_around_path(value["around_path"], folder, files);
  if (value.has("views")) return ViewList{read_views(value["views"], folder, files)};
  return read_half_spheres(value);
}

ViewConstraints read_constraints(const Value& root, const fs::path& folder,
                                 const ViewConstraints& usual, std::vector<fs::path>& files) {
  ViewConstraints limits = usual;
  if (root.has("reach")) read_reach(root["reach"], folder, files, limits);
  if (root.has("view_cone")) limits.view_cone = read_cone(root["view_cone"]);
  read_fields(root, {"", "", {clearance_field(limits), floor_field(limits)}});
  if (root.has("camera_body")) read_body(root["camera_body"], limits);
  return limits;
}

}  // namespace vantage
