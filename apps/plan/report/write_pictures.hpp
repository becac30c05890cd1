#pragma once

#include <filesystem>

#include "plan/report/plan_pictures.hpp"

namespace vantage {

/// How a plan's pictures are to be drawn.
struct PictureRequest {
  int width = 1280;  ///< of overview.png, pixels
  PictureQuality quality = PictureQuality::final;
  StopToken in_time = {};  ///< of final pictures: knows the deadline
  StopToken stop = {};     ///< of drafts: knows none
};

/// Writes a plan's pictures into a folder, with progress on a terminal. Those that are not done in
/// time are drawn as drafts, and a message says so. Runs in the caller's task arena.
/// @throws Error as `write_png` does.
void write_pictures(const std::filesystem::path& folder, const Plan& plan, const WorldModel& world,
                    const PictureRequest& request);

}  // namespace vantage
