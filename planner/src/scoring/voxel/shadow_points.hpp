#pragma once

#include <algorithm>
#include <memory>

#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/points.hpp"

namespace vantage::planner::detail {

/// The centres of a scene's shadow voxels, copied.
inline Points shadow_points(const PlanningScene& scene) {
  const PointsView centres = scene.shadow_centres();
  Points points(centres.size);
  std::copy_n(centres.x, centres.size, points.x.begin());
  std::copy_n(centres.y, centres.size, points.y.begin());
  std::copy_n(centres.z, centres.size, points.z.begin());
  return points;
}

/// The scene's occluders, which live as long as the result does.
inline std::shared_ptr<const Scene> shared_occluders(const PlanningScene& scene) {
  const auto owner = std::make_shared<const PlanningScene>(scene);
  return {owner, &owner->occluders()};
}

}  // namespace vantage::planner::detail
