#pragma once

#include <filesystem>
#include <optional>

#include "vantage/planner/plan.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/image.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// From where to draw the overview of a plan that has a grid: from above, beside the suggested
/// camera, far enough away for a calm perspective. The focal length and the principal point are
/// such that the work area and all cameras fill the picture of `width` × 5/8 `width` pixels.
PinholeCamera overview_camera(const Plan& plan, const WorldModel& world, int width);

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
