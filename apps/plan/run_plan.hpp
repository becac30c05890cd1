#pragma once

#include <filesystem>
#include <vector>

#include "cli/exit_code.hpp"
#include "plan/report/plan_json.hpp"
#include "plan/report/plan_pictures.hpp"
#include "vantage/planner/plan.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// What a command that plans writes, and where.
struct OutputOptions {
  std::vector<int> explain = {};      ///< candidates to explain, by id
  std::filesystem::path folder = {};  ///< empty: nothing is written but the answer on stdout
  bool json = false;                  ///< stdout gets plan.json instead of the summary
  bool save_grid = false;             ///< grid.vdb, labels.npy, regions.npy
  bool save_surface = false;          ///< shadow.ply, shadow_smooth.ply: of the shadow that stays
  bool save_scene = false;            ///< scene.glb: everything, for a viewer
  bool pictures = false;              ///< overview.png, view.png, view_2.png …
  int picture_width = 1280;           ///< of overview.png, pixels
  PictureQuality picture_quality = PictureQuality::final;
};

/// How it is to be computed.
struct RunOptions {
  int threads = 0;                 ///< 0: one per core
  StopToken stop = {};             ///< of the planning
  StopToken drawing = {};          ///< of files and draft pictures: it knows no deadline
  StopToken drawing_in_time = {};  ///< of final pictures: it knows the deadline

  /// For a signal handler.
  std::vector<StopToken> tokens() const { return {stop, drawing, drawing_in_time}; }
};

/// Plans, writes and prints. When a token stops the work, what is done by then is written.
/// @param start when the command began, for `timing_ms`; `record.load_s` is filled in already.
ExitCode run_plan(const WorldModel& world, const PlanRequest& request, PlanRecord record,
                  const OutputOptions& output, const RunOptions& run,
                  StopToken::Clock::time_point start);

}  // namespace vantage
