#include "mesh_tools.hpp"

#include "vantage/volume/carve.hpp"

namespace vantage::detail {
namespace {

// Voxels along the work area's longest side, where only the middle of what is unseen is of
// interest.
constexpr double kCoarse = 40;

PlanningScene carved_scene(const SeenWorld& seen, double voxel_size_m) {
  const auto geometry = GridGeometry::covering(seen.work_area, voxel_size_m);
  return {seen.known, carve(seen.lattices, geometry, seen.known), OccluderMode::mesh};
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
  const bool shortlist = views > std::size_t(options.exact_views);
  const double voxel_size_m =
      shortlist ? options.shortlist_voxel_m : work_area.size().maxCoeff() / kCoarse;
  const PlanningScene carved = carved_scene(seen, voxel_size_m);
  tools.middle_of_unseen = carved.middle_of_shadow();
  if (shortlist) tools.cheap = std::make_shared<const ShadowScorer>(carved, request.range, power);
  return tools;
}

}  // namespace vantage::detail
