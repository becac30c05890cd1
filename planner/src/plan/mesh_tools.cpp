#include "plan/mesh_tools.hpp"

#include "scene/shadow_centroid.hpp"
#include "vantage/planner/voxel_scorer.hpp"
#include "vantage/volume/carve.hpp"
#include "vantage/volume/shadow_filter.hpp"

namespace vantage::detail {
namespace {

// Voxels along the work area's longest side, where only the middle of what is unseen is of
// interest.
constexpr double kCoarse = 40;

std::shared_ptr<const StateGrid> carved(const SeenWorld& seen, double voxel_size_m) {
  return carve(seen.lattices, GridGeometry::covering(seen.work_area, voxel_size_m), seen.known);
}

/// The scene in which views are scored cheaply.
PlanningScene shortlist_scene(const SeenWorld& seen, const MeshOptions& options) {
  std::shared_ptr<const StateGrid> grid = carved(seen, options.shortlist_voxel_m);
  if (options.opening_m > 0) {
    grid = opened_shadow(*grid, opening_radius(*grid, options.opening_m));
  }
  return {seen.known, std::move(grid), OccluderMode::mesh};
}

Eigen::Vector3d middle_of_unseen(const SeenWorld& seen) {
  const std::shared_ptr<const StateGrid> grid =
      seen.opened ? seen.opened : carved(seen, seen.work_area.size().maxCoeff() / kCoarse);
  const Points centres = grid->centres(VoxelState::shadow);
  return middle_of_shadow(*grid, centres);
}

}  // namespace

MeshTools mesh_tools(const WorldModel& world, const Box& work_area, const PlanRequest& request,
                     std::size_t views) {
  const MeshOptions& options = request.method.mesh;
  const double power = request.method.depth_power;
  const SeenWorld seen = seen_world(world, work_area, options);
  MeshTools tools;
  tools.scorer = std::make_shared<const MeshScorer>(seen, request.range, power, options.image_width,
                                                    options.weight);
  tools.middle_of_unseen = middle_of_unseen(seen);
  if (views > std::size_t(options.exact_views)) {
    const PlanningScene scene = shortlist_scene(seen, options);
    const auto shadow = std::make_shared<const ShadowScorer>(scene, request.range, power);
    tools.cheap = shadow;
    if (options.weight == MeshWeight::volume) {
      tools.cheap = std::make_shared<const VoxelScorer>(scene);
    }
    tools.cheap_sight = shadow;
  }
  return tools;
}

}  // namespace vantage::detail
