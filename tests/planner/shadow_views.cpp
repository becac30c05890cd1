#include "planner/shadow_views.hpp"

#include "reference/random_workcell.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "vantage/volume/advanced/voxel_surface.hpp"

namespace vantage::test {
namespace {

OccluderMode mode_of(std::uint32_t seed) {
  return seed % 2 == 0 ? OccluderMode::mesh : OccluderMode::voxels;
}

}  // namespace

PlanningScene shadow_scene(std::uint32_t seed) {
  const WorldModel world = random_workcell(seed);
  VolumeOptions options;
  options.occluders = mode_of(seed);
  const double voxel_m = 0.008 + 0.002 * (seed % 5);
  return {world, classify(world, GridGeometry::covering(random_workcell_area(), voxel_m), options),
          options.occluders};
}

std::shared_ptr<const Scene> all_surfaces(std::uint32_t seed, const StateGrid& grid) {
  SceneBuilder builder;
  add_occluders(random_workcell(seed), grid, mode_of(seed), builder);
  builder.add_mesh(voxel_faces(grid, VoxelState::shadow));
  return builder.build();
}

PinholeCamera shadow_view_anywhere(Random& random, const PlanningScene& scene, int width,
                                   int height) {
  const double focal = width * random.uniform(0.5, 1.5);
  const PointsView shadow = scene.shadow_centres();
  Eigen::Vector3d target = random.in_cube(0.1) + Eigen::Vector3d(0, 0, 0.1);
  if (shadow.size > 0 && random.below(4) != 0) {
    target = shadow[random.below(std::uint32_t(shadow.size))].cast<double>();
  }
  Eigen::Vector3d direction = random.direction();
  const double distance[] = {0.001, 0.02, 0.05, 0.15, 0.3, 0.5, 0.9};
  Eigen::Vector3d eye = target + distance[random.below(7)] * direction;
  switch (random.below(8)) {
    case 0: {  // along the faces, in the plane of some of them, or a hair off it
      const double off_m[] = {0, 0, 1e-6, -3e-6, 1e-5, -2e-5, 1e-4, -3e-4};
      eye.z() = scene.grid().geometry().corner({0, 0, int(random.below(8))}).z();
      eye.z() += off_m[random.below(8)];
      break;
    }
    case 1:  // straight down: pixels' rays and faces are parallel
      eye = target + Eigen::Vector3d(0, 0, distance[2 + random.below(5)]);
      break;
    case 2:  // away from it
      target = eye + random.direction();
      break;
    default:
      break;
  }
  if (eye == target) eye.x() += 0.01;
  return {{width, height, focal, focal * random.uniform(0.9, 1.1), width * random.uniform(0.3, 0.7),
           height * random.uniform(0.3, 0.7)},
          Pose::looking_at(eye, target),
          {random.below(2) == 0 ? 0.01 : 0.1, random.below(3) == 0 ? 0.4 : 1.5}};
}

PinholeCamera shadow_view_outside(Random& random, int width, int height) {
  Eigen::Vector3d direction = random.direction();
  direction.z() = std::abs(direction.z());
  const Eigen::Vector3d centre(0, 0, 0.08);
  const double focal = width * 0.9;
  return {{width, height, focal, focal, (width - 1) / 2.0, (height - 1) / 2.0},
          Pose::looking_at(centre + random.uniform(0.4, 0.7) * direction, centre),
          {0.1, 1.5}};
}

}  // namespace vantage::test
