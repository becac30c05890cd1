#include "plan/run_options.hpp"

#include <chrono>

#include "cli/number_checks.hpp"

namespace vantage {

void CommonOptions::add_to(CLI::App& verb) {
  CLI::Option* folder = verb.add_option("-o,--output", output.folder,
                                        "Folder for the results; it is made if it is missing")
                            ->take_last();  // apps/demo.sh gives one, which its user may replace
  verb.add_flag("--json", output.json, "Print plan.json on stdout instead of a summary");
  verb.add_flag(
          "--save-grid", output.save_grid,
          "Write the state of every voxel as grid.vdb and labels.npy, and the shadow's connected "
          "regions as regions.npy")
      ->needs(folder);
  verb.add_flag("--save-surface", output.save_surface,
                "Write the surface of the shadow that stays: shadow.ply, voxel by voxel, and "
                "shadow_smooth.ply; with --method mesh also unseen.ply: what no depth image "
                "shows")
      ->needs(folder);
  verb.add_flag("--save-scene", output.save_scene, "Write scene.glb: voxels and cameras in 3D")
      ->needs(folder);
  verb.add_option("--picture-width", output.picture_width, "Width of overview.png, pixels")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  verb.add_option("--threads", threads, "Threads to use (0: all)")->check(CLI::Range(0, 1024));
  verb.add_option("--deadline-ms", deadline_ms,
                  "Return the best view found after this time (exit code 5 if not all were scored)")
      ->check(number_between(0.0, 1e9));
}

RunOptions CommonOptions::run(StopToken::Clock::time_point start) const {
  if (!deadline_ms) return {.threads = threads};
  const auto time = std::chrono::duration_cast<StopToken::Clock::duration>(
      std::chrono::duration<double, std::milli>(*deadline_ms));
  return {.threads = threads, .stop = StopToken::with_deadline(start + time)};
}

}  // namespace vantage
