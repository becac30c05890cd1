#pragma once

#include <memory>

#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/methods.hpp"
#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

/// The scorer of a method.
/// @param scene made from `world`.
/// @param range of the views that are to be scored.
/// @param noise of the depths that the world's cameras measured: `VolumeOptions::noise`.
/// @throws Error as the method's `check` does, for the mesh method also as `seen_world` does.
VANTAGE_API std::unique_ptr<const ViewScorer> make_view_scorer(const Method& method,
                                                               const PlanningScene& scene,
                                                               const WorldModel& world,
                                                               const DepthRange& range,
                                                               const StereoNoise& noise);

}  // namespace vantage
