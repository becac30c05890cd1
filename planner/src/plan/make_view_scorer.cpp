#include "vantage/planner/advanced/make_view_scorer.hpp"

#include "vantage/planner/advanced/light_scorer.hpp"
#include "vantage/planner/advanced/mesh_scorer.hpp"
#include "vantage/planner/advanced/shadow_scorer.hpp"
#include "vantage/planner/advanced/voxel_scorer.hpp"

namespace vantage {
namespace {

/// Makes a scorer of whatever method it is called with.
struct ScorerMaker {
  const PlanningScene& scene;
  const WorldModel& world;
  const DepthRange& range;
  const StereoNoise& noise;

  std::unique_ptr<const ViewScorer> operator()(const VoxelMethod&) const {
    return std::make_unique<VoxelScorer>(scene);
  }
  std::unique_ptr<const ViewScorer> operator()(const ShadowMethod& method) const {
    return std::make_unique<ShadowScorer>(scene, range, method.depth_power);
  }
  std::unique_ptr<const ViewScorer> operator()(const MeshMethod& method) const {
    return std::make_unique<MeshScorer>(
        seen_world(world, scene.grid().geometry().box(), noise, method), range, method.depth_power,
        method.image_width, method.weight);
  }
  std::unique_ptr<const ViewScorer> operator()(const LightMethod&) const {
    return std::make_unique<LightScorer>(scene, world);
  }
};

}  // namespace

std::unique_ptr<const ViewScorer> make_view_scorer(const Method& method, const PlanningScene& scene,
                                                   const WorldModel& world, const DepthRange& range,
                                                   const StereoNoise& noise) {
  check(method);
  return std::visit(ScorerMaker{scene, world, range, noise}, method);
}

}  // namespace vantage
