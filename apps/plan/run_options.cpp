#include "plan/run_options.hpp"

#include <chrono>
#include <map>
#include <string>

#include "cli/help_formatter.hpp"
#include "cli/number_checks.hpp"
#include "cli/shared_options.hpp"

namespace vantage {
namespace {

const std::map<std::string, PictureQuality> kQualities = {{"draft", PictureQuality::draft},
                                                          {"final", PictureQuality::final}};

}  // namespace

void CommonOptions::add_to(CLI::App& verb) {
  CLI::Option* folder = add_output_option(verb, output.folder, "the results")->take_last();
  add_json_flag(verb, output.json, "plan.json");
  verb.add_flag(
          "--save-grid", output.save_grid,
          "Write the state of every voxel as grid.vdb and labels.npy, and the shadow's connected "
          "regions as regions.npy")
      ->needs(folder)
      ->group("Output");
  verb.add_flag("--save-surface", output.save_surface,
                "Write the surface of the shadow that stays: shadow.ply, voxel by voxel, and "
                "shadow_smooth.ply; with --method mesh also unseen.ply: what no depth image "
                "shows")
      ->needs(folder)
      ->group("Output");
  verb.add_flag("--save-scene", output.save_scene, "Write scene.glb: voxels and cameras in 3D")
      ->needs(folder)
      ->group("Output");
  verb.add_option("--picture-quality", output.picture_quality,
                  "Quality of the pictures; a draft takes a fifth of the time")
      ->transform(CLI::CheckedTransformer(kQualities))
      ->option_text("draft|final")
      ->default_str("final")
      ->group(expert_group("Output"));
  verb.add_option("--picture-width", output.picture_width, "Width of overview.png, pixels")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str()
      ->group(expert_group("Output"));
  add_threads_option(verb, threads);
  verb.add_option("--deadline-ms", deadline_ms,
                  "Return the best view found within this time, milliseconds; exit code 5 if not "
                  "all candidates were scored by then. Pictures that are not finished by then are "
                  "drawn as drafts, which takes some tenths of a second more")
      ->check(number_between(0.0, 1e9))
      ->group("Run");
}

RunOptions CommonOptions::run(StopToken::Clock::time_point start) const {
  if (!deadline_ms) return {.threads = threads};
  const auto time = std::chrono::duration_cast<StopToken::Clock::duration>(
      std::chrono::duration<double, std::milli>(*deadline_ms));
  return {.threads = threads,
          .stop = StopToken::with_deadline(start + time),
          .drawing_in_time = StopToken::with_deadline(start + time)};
}

}  // namespace vantage
