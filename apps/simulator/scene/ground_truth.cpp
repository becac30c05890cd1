#include "simulator/scene/ground_truth.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

WorldModel true_world(const SimulatedScene& scene, std::span<const PinholeCamera> cameras) {
  WorldModel world;
  for (const SimulatedBody& body : scene.bodies()) {
    world.static_structures.push_back(
        {body.name, {body.shape, &body.shape->mesh}, body.T_world_body});
  }
  for (const PinholeCamera& camera : cameras) {
    world.cameras.push_back({std::to_string(world.cameras.size()), camera, nullptr});
  }
  return world;
}

}  // namespace

GroundTruth::GroundTruth(const SimulatedScene& scene, std::span<const PinholeCamera> cameras,
                         const GridGeometry& geometry)
    : world_(true_world(scene, cameras)) {
  grid_ = classify(world_, geometry, {.occluders = OccluderMode::mesh, .anti_alias = false});
  rays_ = known_scene(world_);
}

double GroundTruth::seen_m3(const StateGrid& believed, const PinholeCamera& view) const {
  const Points shadow = believed.centres(VoxelState::shadow);
  std::vector<std::uint8_t> in_view(shadow.size());
  view.in_view(shadow, in_view);
  Points candidates;
  for (std::size_t i = 0; i < shadow.size(); ++i) {
    if (in_view[i]) candidates.push_back(shadow[i]);
  }
  std::vector<std::uint8_t> blocked(candidates.size());
  rays_->occluded(candidates, view.centre().cast<float>(), blocked);
  const auto seen = std::count(blocked.begin(), blocked.end(), std::uint8_t(0));
  return double(seen) * believed.geometry().voxel_volume_m3();
}

}  // namespace vantage
