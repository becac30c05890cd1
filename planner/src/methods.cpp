#include "vantage/planner/methods.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "vantage/planner/light_scorer.hpp"
#include "vantage/planner/shadow_scorer.hpp"
#include "vantage/planner/voxel_scorer.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = {"voxel", "shadow", "light"};
  return names;
}

std::unique_ptr<const ViewScorer> make_view_scorer(const MethodOptions& options,
                                                   const PlanningScene& scene,
                                                   const WorldModel& world,
                                                   const DepthRange& range) {
  if (options.name == "voxel") return std::make_unique<VoxelScorer>(scene);
  if (options.name == "shadow") {
    return std::make_unique<ShadowScorer>(scene, range, options.depth_power);
  }
  if (options.name == "light") return std::make_unique<LightScorer>(scene, world);
  throw bad_input("method", fmt::format("\"{}\" is unknown; expected one of {}", options.name,
                                        fmt::join(method_names(), ", ")));
}

}  // namespace vantage
