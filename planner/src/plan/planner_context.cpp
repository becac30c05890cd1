#include "plan/planner_context.hpp"

#include <algorithm>

#include "scene/planning_scene.hpp"
#include "search/two_stage_search.hpp"
#include "vantage/planner/advanced/shadow_scorer.hpp"
#include "vantage/planner/advanced/voxel_scorer.hpp"
#include "vantage/volume/advanced/carve.hpp"
#include "vantage/volume/advanced/shadow_filter.hpp"

namespace vantage::planner::detail {
namespace {

/// What the servo looks at, and which point it measures distances to.
struct ServoSight {
  std::shared_ptr<const ShadowView> view;
  Eigen::Vector3d centre;
};

/// The servo's view may be the scorer itself.
std::shared_ptr<const ShadowView> servo_view(const std::shared_ptr<const ViewScorer>& scorer,
                                             const PlanningScene& scene, const DepthRange& range) {
  if (auto view = std::dynamic_pointer_cast<const ShadowView>(scorer)) return view;
  return std::make_shared<const ShadowScorer>(scene, range, 0);
}

}  // namespace

PlannerContext::PlannerContext(const WorldModel& world, const PlanningScene& scene,
                               const PlanRequest& request, std::size_t candidates)
    : options_(request.search),
      shortlist_(std::max(request.method.mesh.shortlist, request.search.ranked)),
      context_{nullptr, nullptr, nullptr,
               PinholeCamera(request.intrinsics, Pose(), request.range, "movable camera"),
               Utility(request.search.travel)},
      polished_views_(std::size_t(request.polish.views)) {
  ServoSight observation;
  if (request.method.name == "mesh") {
    const std::size_t views = candidates * std::size_t(request.servo.iterations + 1);
    const MeshTools mesh = mesh_tools(world, scene.grid().geometry().box(), request, views);
    context_.scorer = mesh.scorer;
    cheap_ = mesh.cheap;
    observation = {mesh.scorer, mesh.middle_of_unseen};
    if (mesh.cheap != nullptr) observation.view = mesh.cheap_sight;
  } else {
    context_.scorer = make_view_scorer(request.method, scene, world, request.range);
    observation.centre = scene.middle_of_shadow();
    if (request.servo.iterations > 0)
      observation.view = servo_view(context_.scorer, scene, request.range);
  }
  context_.validity =
      std::make_shared<const ViewValidityChecker>(request.constraints, scene, request.range);
  voxels_ = std::dynamic_pointer_cast<const VoxelScorer>(context_.scorer);
  if (voxels_ == nullptr) voxels_ = std::make_shared<const VoxelScorer>(scene);
  if (request.servo.iterations > 0) {
    context_.servo = std::make_shared<const ServoRefiner>(
        observation.view, context_.validity, context_.camera, observation.centre, request.servo);
  }
  if (request.polish.views > 0) {
    polisher_ = std::make_shared<const ViewPolisher>(context_.scorer, context_.validity,
                                                     context_.camera, observation.centre,
                                                     request.polish, request.search.travel);
  }
}

SearchResult PlannerContext::search(std::span<const ViewCandidate> candidates,
                                    const StopToken& stop) const {
  const ViewSearch exact = search_by(context_.scorer, options_.ranked);
  if (cheap_ == nullptr) return exact.run(candidates, stop);
  return ShortlistSearch(search_by(cheap_, shortlist_), exact, options_.ranked, shortlist_)
      .run(candidates, stop);
}

std::vector<ScoredStep> PlannerContext::trace(const ViewCandidate& candidate,
                                              const StopToken& stop) const {
  return search_by(context_.scorer, options_.ranked).trace(candidate, stop);
}

ViewSearch PlannerContext::search_by(std::shared_ptr<const ViewScorer> scorer, int ranked) const {
  SearchOptions options = options_;
  options.ranked = ranked;
  return {std::move(scorer), context_.validity, context_.servo, context_.camera, options};
}

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
    grid = morphological_open(*grid, opening_radius(*grid, options.opening_m));
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
  MeshTools context;
  context.scorer = std::make_shared<const MeshScorer>(seen, request.range, power,
                                                      options.image_width, options.weight);
  context.middle_of_unseen = middle_of_unseen(seen);
  if (views > std::size_t(options.exact_views)) {
    const PlanningScene scene = shortlist_scene(seen, options);
    const auto shadow = std::make_shared<const ShadowScorer>(scene, request.range, power);
    context.cheap = shadow;
    if (options.weight == MeshWeight::volume) {
      context.cheap = std::make_shared<const VoxelScorer>(scene);
    }
    context.cheap_sight = shadow;
  }
  return context;
}

}  // namespace vantage::planner::detail
