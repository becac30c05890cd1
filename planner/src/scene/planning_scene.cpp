#include "scene/planning_scene.hpp"

#include <tbb/parallel_invoke.h>

#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "vantage/volume/advanced/voxel_surface.hpp"

namespace vantage {

PlanningScene::PlanningScene(const WorldModel& world, std::shared_ptr<const StateGrid> grid,
                             OccluderMode mode)
    : grid_(std::move(grid)) {
  tbb::parallel_invoke(
      [&] {
        occluders_ = occluder_scene(world, *grid_, mode);
        shadow_centres_ = std::make_shared<const Points>(grid_->centres(VoxelState::shadow));
      },
      [&] {
        ShadowSurface surface = shadow_surface(*grid_, mode);
        shadow_faces_ = std::make_shared<const TriangleMesh>(std::move(surface.open));
        SceneBuilder builder;
        add_occluders(world, *grid_, mode, builder);
        builder.add_mesh(*shadow_faces_);
        builder.add_mesh(surface.covered);
        surfaces_ = builder.build();
      });
}

Eigen::Vector3d PlanningScene::middle_of_shadow() const {
  return planner::detail::middle_of_shadow(*grid_, shadow_centres());
}

Eigen::Vector3d planner::detail::middle_of_shadow(const StateGrid& grid, PointsView centres) {
  if (centres.size == 0) return grid.geometry().box().centre();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < centres.size; ++i) sum += centres[i].cast<double>();
  return sum / double(centres.size);
}

}  // namespace vantage
