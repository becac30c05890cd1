#pragma once

#include <filesystem>
#include <optional>

#include "vantage/planner/plan.hpp"
#include "vantage/raycore/image.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// Pictures of a plan that has a grid. Occupied voxels are green, shadow red, what the suggested
/// view reveals cyan and half transparent, the given cameras grey, the suggested one red.

/// The work area from outside, with all cameras and their frusta; `width` × 5/8 `width` pixels.
/// Nothing if it was stopped.
std::optional<ColorImage> overview(const Plan& plan, const WorldModel& world, int width,
                                   const StopToken& stop = {});
void write_overview(const std::filesystem::path& path, const Plan& plan, const WorldModel& world,
                    int width, const StopToken& stop = {});

/// What the suggested camera would see. Needs a plan with a best view.
void write_suggested_view(const std::filesystem::path& path, const Plan& plan,
                          const StopToken& stop = {});

/// The overview as a glTF model, to turn around in a viewer.
void write_scene_model(const std::filesystem::path& path, const Plan& plan,
                       const WorldModel& world);

}  // namespace vantage
