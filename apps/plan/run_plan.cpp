#include "plan/run_plan.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <optional>

#include "cli/progress_line.hpp"
#include "cli/workers.hpp"
#include "plan/report/plan_pictures.hpp"
#include "plan/report/plan_summary.hpp"
#include "plan/report/write_pictures.hpp"
#include "process/output_folder.hpp"
#include "process/result_output.hpp"
#include "vantage/planner/advanced/mesh_scorer.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/mesh_io.hpp"
#include "vantage/volume/advanced/carve.hpp"
#include "vantage/volume/advanced/smooth_surface.hpp"
#include "vantage/volume/advanced/voxel_surface.hpp"
#include "vantage/volume/grid_files.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

/// What no depth image shows, known objects or not, as the mesh method filters it.
TriangleMesh unseen_surface_of(const Plan& plan, const WorldModel& world,
                               const MeshMethod& method) {
  const GridGeometry& geometry = plan.grid->geometry();
  const SeenWorld seen = seen_world(world, geometry.box(), plan.request.volume.noise, method);
  return seen.opened ? unseen_surface(seen.lattices, *seen.opened)
                     : unseen_surface(seen.lattices, geometry);
}

void write_extras(const Plan& plan, const ShadowRegions& regions, const WorldModel& world,
                  const OutputOptions& output, const RunOptions& run) {
  const StopToken& stop = run.drawing;
  const auto write = [&](bool wanted, const char* name, const auto& writer) {
    if (!wanted || stop.stop_requested()) return;
    writer(output.folder / name);
    if (!stop.stop_requested()) spdlog::info("wrote {}", (output.folder / name).string());
  };
  write(output.save_grid, "grid.vdb", [&](const fs::path& p) { plan.grid->write_vdb(p); });
  write(output.save_grid, "labels.npy",
        [&](const fs::path& p) { write_labels_npy(p, *plan.grid); });
  write(output.save_grid, "regions.npy", [&](const fs::path& p) { write_regions_npy(p, regions); });
  write(output.save_surface, "shadow.ply",
        [&](const fs::path& p) { write_ply(p, voxel_faces(*plan.grid, VoxelState::shadow)); });
  write(output.save_surface, "shadow_smooth.ply",
        [&](const fs::path& p) { write_ply(p, smooth_surface(*plan.grid, VoxelState::shadow)); });
  const auto* const mesh = std::get_if<MeshMethod>(&plan.request.method);
  write(output.save_surface && mesh != nullptr, "unseen.ply",
        [&](const fs::path& p) { write_ply(p, unseen_surface_of(plan, world, *mesh)); });
  write(output.save_scene, "scene.glb",
        [&](const fs::path& p) { write_scene_model(p, plan, world); });
  if (output.pictures && !stop.stop_requested()) {
    write_pictures(output.folder, plan, world,
                   {output.picture_width, output.picture_quality, run.drawing_in_time, stop});
  }
}

void warn_of(const Plan& plan) {
  if (plan.classified == nullptr) return;
  for (const std::string& warning : plan.classified->report().warnings) {
    spdlog::warn("{}", warning);
  }
}

ExitCode exit_code_of(const Plan& plan) {
  switch (plan.stopped) {
    case StopReason::cancelled:
      return ExitCode::cancelled;
    case StopReason::deadline:
      return ExitCode::deadline;
    case StopReason::none:
      break;
  }
  return plan.best() != nullptr ? ExitCode::ok : ExitCode::no_feasible_view;
}

/// Asked for before the work, so that a wrong id costs nothing.
void check_explained(const PlanRequest& request, const std::vector<int>& ids) {
  if (ids.empty()) return;
  const std::size_t count = view_count(request.candidates, request.work_area);
  for (const int id : ids) {
    if (id >= 0 && std::size_t(id) < count) continue;
    throw bad_input("--explain",
                    fmt::format("found candidate {}; expected 0 to {}", id, count - 1));
  }
}

}  // namespace

ExitCode run_plan(const WorldModel& world, const PlanRequest& request, PlanRecord record,
                  const OutputOptions& output, const RunOptions& run,
                  StopToken::Clock::time_point start) {
  Workers workers(run.threads);
  check_explained(request, output.explain);
  if (!output.folder.empty()) make_output_folder(output.folder);

  std::optional<ShadowRegions> regions;
  std::vector<ViewExplanation> explained;
  const Plan plan = workers.execute([&] {
    const ProgressLine progress("planning", run.stop);
    Plan result = plan_next_view(world, request, run.stop);
    if (result.classified != nullptr) {
      regions.emplace(*result.classified);
      explained = explain_views(world, result, output.explain, run.stop);
      result.context.reset();  // large, and of no more use
    }
    return result;
  });
  record.total_s = std::chrono::duration<double>(StopToken::Clock::now() - start).count();
  record.config.update(config_of(plan.request));
  warn_of(plan);
  const ShadowRegions* const found = regions ? &*regions : nullptr;
  const nlohmann::ordered_json json = plan_to_json(plan, found, explained, record);
  if (!output.folder.empty()) {
    write_file(output.folder / "plan.json", json_text(json));
    spdlog::info("wrote {}", (output.folder / "plan.json").string());
  }
  const std::optional<Error> lost =
      try_print_result(output.json, json, [&] { return summary_of(plan, found, explained); });
  if (regions) {
    workers.execute([&] { write_extras(plan, *regions, world, output, run); });
  }
  if (lost) throw *lost;
  if (run.drawing.stop_requested()) return ExitCode::cancelled;
  return exit_code_of(plan);
}

}  // namespace vantage
