#include "planning_tools.hpp"

#include "vantage/planner/shadow_scorer.hpp"

namespace vantage::detail {
namespace {

/// The servo's view may be the scorer itself.
std::shared_ptr<const ShadowView> shadow_view(const std::shared_ptr<const ViewScorer>& scorer,
                                              const PlanningScene& scene, const DepthRange& range) {
  if (auto view = std::dynamic_pointer_cast<const ShadowView>(scorer)) return view;
  return std::make_shared<const ShadowScorer>(scene, range, 0);
}

}  // namespace

PlanningTools::PlanningTools(const WorldModel& world, const PlanningScene& scene,
                             const PlanRequest& request)
    : options_(request.search),
      tools_{nullptr, nullptr, nullptr,
             PinholeCamera(request.intrinsics, Pose(), request.range, "movable camera"),
             Utility(request.search.travel)} {
  tools_.scorer = make_view_scorer(request.method, scene, world, request.range);
  tools_.checker = std::make_shared<const ViewChecker>(request.constraints, scene, request.range);
  voxels_ = std::dynamic_pointer_cast<const VoxelScorer>(tools_.scorer);
  if (voxels_ == nullptr) voxels_ = std::make_shared<const VoxelScorer>(scene);
  if (request.servo.iterations == 0) return;
  tools_.servo = std::make_shared<const ServoRefiner>(
      shadow_view(tools_.scorer, scene, request.range), tools_.checker, tools_.camera,
      scene.middle_of_shadow(), request.servo);
}

ViewSearch PlanningTools::search() const {
  return {tools_.scorer, tools_.checker, tools_.servo, tools_.camera, options_};
}

}  // namespace vantage::detail
