#include "plan/method_tools.hpp"

#include "scene/planning_scene.hpp"
#include "vantage/planner/advanced/light_scorer.hpp"
#include "vantage/planner/advanced/mesh_scorer.hpp"
#include "vantage/planner/advanced/shadow_scorer.hpp"
#include "vantage/volume/advanced/carve.hpp"
#include "vantage/volume/advanced/shadow_filter.hpp"

namespace vantage::planner::detail {
namespace {

// Voxels along the work area's longest side, where only the middle of what is unseen is of
// interest.
constexpr double kCoarse = 40;

std::shared_ptr<const StateGrid> carved(const SeenWorld& seen, double voxel_size_m) {
  return carve(seen.lattices, GridGeometry::covering(seen.work_area, voxel_size_m), seen.known);
}

/// The scene in which views are scored cheaply.
PlanningScene shortlist_scene(const SeenWorld& seen, const MeshMethod& method) {
  std::shared_ptr<const StateGrid> grid = carved(seen, method.shortlist_voxel_m);
  if (method.opening_m > 0) {
    grid = morphological_open(*grid, opening_radius(*grid, method.opening_m));
  }
  return {seen.known, std::move(grid), OccluderMode::mesh};
}

Eigen::Vector3d middle_of_unseen(const SeenWorld& seen) {
  const std::shared_ptr<const StateGrid> grid =
      seen.opened ? seen.opened : carved(seen, seen.work_area.size().maxCoeff() / kCoarse);
  const Points centres = grid->centres(VoxelState::shadow);
  return middle_of_shadow(*grid, centres);
}

/// Makes the tools of whatever method it is called with.
struct ToolMaker {
  const WorldModel& world;
  const PlanningScene& scene;
  const PlanRequest& request;
  std::size_t candidates;

  MethodTools operator()(const VoxelMethod&) const {
    const auto bound = voxels();
    const auto expected = gain();
    std::shared_ptr<const ViewScorer> scorer = expected;
    if (request.value == ViewValue::bound) scorer = bound;
    return {scorer, bound, expected, plain_sight(), scene.middle_of_shadow()};
  }

  MethodTools operator()(const ShadowMethod& method) const {
    const auto scorer =
        std::make_shared<const ShadowScorer>(scene, request.range, method.depth_power);
    return {scorer, voxels(), gain(), scorer, scene.middle_of_shadow()};
  }

  MethodTools operator()(const LightMethod&) const {
    return {std::make_shared<const LightScorer>(scene, world), voxels(), gain(), plain_sight(),
            scene.middle_of_shadow()};
  }

  MethodTools operator()(const MeshMethod& method) const {
    const SeenWorld seen =
        seen_world(world, scene.grid().geometry().box(), request.volume.noise, method);
    const auto scorer = std::make_shared<const MeshScorer>(seen, request.range, method.depth_power,
                                                           method.image_width, method.weight);
    MethodTools tools{scorer, voxels(), gain(), scorer, middle_of_unseen(seen)};
    const std::size_t views = candidates * std::size_t(request.servo.iterations + 1);
    if (views > std::size_t(method.exact_views)) add_shortlist(seen, method, tools);
    return tools;
  }

 private:
  std::shared_ptr<const VoxelScorer> voxels() const {
    return std::make_shared<const VoxelScorer>(scene);
  }

  std::shared_ptr<const ExpectedScorer> gain() const {
    return std::make_shared<const ExpectedScorer>(scene, world, request.volume,
                                                  request.gain_options());
  }

  /// For scorers that do not look at images of the shadow themselves.
  std::shared_ptr<const ShadowView> plain_sight() const {
    if (request.servo.iterations == 0) return nullptr;
    return std::make_shared<const ShadowScorer>(scene, request.range, 0);
  }

  void add_shortlist(const SeenWorld& seen, const MeshMethod& method, MethodTools& tools) const {
    const PlanningScene carved_scene = shortlist_scene(seen, method);
    const auto shadow =
        std::make_shared<const ShadowScorer>(carved_scene, request.range, method.depth_power);
    tools.cheap = shadow;
    if (method.weight == MeshWeight::volume) {
      tools.cheap = std::make_shared<const VoxelScorer>(carved_scene);
    }
    tools.sight = shadow;
    tools.shortlist = method.shortlist;
  }
};

}  // namespace

MethodTools method_tools(const WorldModel& world, const PlanningScene& scene,
                         const PlanRequest& request, std::size_t candidates) {
  return std::visit(ToolMaker{world, scene, request, candidates}, request.method);
}

}  // namespace vantage::planner::detail
