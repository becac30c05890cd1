#include "vantage/planner/methods.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "vantage/planner/advanced/light_scorer.hpp"
#include "vantage/planner/advanced/shadow_scorer.hpp"
#include "vantage/planner/advanced/voxel_scorer.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = {"voxel", "shadow", "mesh", "light"};
  return names;
}

void MethodOptions::check() const {
  mesh.check();
  const std::vector<std::string>& names = method_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw bad_input("method", fmt::format("\"{}\" is unknown; expected one of {}", name,
                                          fmt::join(names, ", ")));
  }
  if (depth_power >= 0 && depth_power <= 16) return;  // false for NaN
  throw bad_input("method",
                  fmt::format("a depth power of {}; expected a number from 0 to 16", depth_power));
}

std::unique_ptr<const ViewScorer> make_view_scorer(const MethodOptions& options,
                                                   const PlanningScene& scene,
                                                   const WorldModel& world,
                                                   const DepthRange& range) {
  options.check();
  if (options.name == "shadow") {
    return std::make_unique<ShadowScorer>(scene, range, options.depth_power);
  }
  if (options.name == "mesh") {
    return std::make_unique<MeshScorer>(
        seen_world(world, scene.grid().geometry().box(), options.mesh), range, options.depth_power,
        options.mesh.image_width, options.mesh.weight);
  }
  if (options.name == "light") return std::make_unique<LightScorer>(scene, world);
  return std::make_unique<VoxelScorer>(scene);
}

}  // namespace vantage
