#include "plan/volume_json.hpp"

#include <algorithm>

#include "cli/pose_json.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostRegions = 20;

double volume_m3(const Plan& plan, std::uint64_t voxels) {
  return double(voxels) * plan.classified->geometry().voxel_volume_m3();
}

Json region_json(const ShadowRegion& region, const GridGeometry& geometry) {
  const double voxel_m3 = geometry.voxel_volume_m3();
  return {{"volume_m3", double(region.voxels) * voxel_m3},
          {"unseen_m3", double(region.unseen_voxels) * voxel_m3},
          {"centroid_m", to_json(region.centroid_m)},
          {"min_m", to_json(geometry.corner(region.min_voxel))},
          {"max_m", to_json(geometry.corner(region.max_voxel + Eigen::Vector3i::Ones()))}};
}

}  // namespace

Json volumes_json(const Plan& plan) {
  if (plan.classified == nullptr) return nullptr;
  const StateGrid& grid = *plan.classified;
  const std::uint64_t shadow = grid.count(VoxelState::shadow), unseen = grid.report().unseen_shadow;
  return {{"work_area", grid.geometry().volume_m3()},
          {"occupied", grid.volume_m3(VoxelState::occupied)},
          {"free", grid.volume_m3(VoxelState::free)},
          {"shadow", grid.volume_m3(VoxelState::shadow)},
          {"shadow_hidden", volume_m3(plan, shadow - unseen)},
          {"shadow_unseen", volume_m3(plan, unseen)}};
}

Json anti_alias_json(const Plan& plan) {
  if (plan.classified == nullptr) return nullptr;
  return {{"applied", plan.request.volume.anti_aliased()},
          {"volume_m3", volume_m3(plan, plan.classified->report().aliased_shadow)}};
}

Json conflicts_json(const Plan& plan) {
  if (plan.classified == nullptr) return nullptr;
  Json list = Json::array();
  for (const ObjectConflict& conflict : plan.classified->report().conflicts) {
    list.push_back({{"object", conflict.object},
                    {"volume_m3", volume_m3(plan, conflict.voxels)},
                    {"object_volume_m3", volume_m3(plan, conflict.of_voxels)}});
  }
  return list;
}

Json regions_json(const ShadowRegions* regions) {
  if (regions == nullptr) return nullptr;
  Json largest = Json::array();
  for (std::size_t r = 0; r < std::min(regions->list().size(), kMostRegions); ++r) {
    largest.push_back(region_json(regions->list()[r], regions->geometry()));
  }
  return {{"count", regions->list().size()}, {"largest", largest}};
}

Json warnings_json(const Plan& plan) {
  return plan.classified == nullptr ? Json::array() : Json(plan.classified->report().warnings);
}

}  // namespace vantage
