#include "plan/report/candidate_json.hpp"

#include "cli/pose_json.hpp"
#include "options/candidate_fields.hpp"
#include "options/field_json.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

Json box_json(const Box& box) {
  return {{"min_m", to_json(box.min())}, {"max_m", to_json(box.max())}};
}

Json kind_json(const HalfSpheres& given, const Box& work_area) {
  HalfSpheres set = resolve_defaults(given, work_area);
  return to_json(fields_of(set));
}

Json kind_json(BoxGrid grid, const Box&) {
  Json json = box_json(grid.box);
  json["counts"] = {grid.counts.x(), grid.counts.y(), grid.counts.z()};
  json.update(to_json(fields_of(grid)));
  return {{"box_grid", json}};
}

Json kind_json(AroundPath around, const Box&) {
  Json json{{"path", around.path.size()}};
  json.update(to_json(fields_of(around)));
  return {{"around_path", json}};
}

Json kind_json(const ViewList& list, const Box&) {
  return {{"views", list.poses.size()}};
}

Json shell_json(const Reach& reach) {
  return {{"base_m", to_json(reach.base_m)}, {"min_m", reach.min_m}, {"max_m", reach.max_m}};
}

Json map_json(const ReachMap& map) {
  return {{"origin_m", to_json(map.origin_m)},
          {"cell_m", map.cell_m},
          {"size", {map.size.x(), map.size.y(), map.size.z()}}};
}

Json body_json(const ViewConstraints& limits) {
  if (const auto* sphere = std::get_if<SphereBody>(&limits.body)) {
    return {{"sphere", {{"radius_m", sphere->radius_m}}}};
  }
  if (const auto* box = std::get_if<BoxBody>(&limits.body)) return {{"box", box_json(box->box)}};
  return nullptr;
}

}  // namespace

Json config_of(const CandidateSet& set, const Box& work_area) {
  return std::visit([&](const auto& kind) { return kind_json(kind, work_area); }, set);
}

Json config_of(const ViewConstraints& limits) {
  Json cone;
  if (limits.view_cone) {
    cone = {{"axis", to_json(limits.view_cone->axis)},
            {"half_angle_rad", limits.view_cone->half_angle_rad}};
  }
  return {{"reach",
           {{"shell", limits.reach ? shell_json(*limits.reach) : Json()},
            {"box", limits.reach_box ? box_json(*limits.reach_box) : Json()},
            {"map", limits.reach_map ? map_json(*limits.reach_map) : Json()}}},
          {"view_cone", cone},
          {"camera_body", body_json(limits)},
          {"clearance_m", limits.clearance_m},
          {"floor_z_m", limits.floor_z_m ? Json(*limits.floor_z_m) : Json()}};
}

}  // namespace vantage
