#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

#include "cli/command.hpp"
#include "cli/interruptible_run.hpp"
#include "cli/run_time.hpp"
#include "cli/shared_options.hpp"
#include "options/unused_options.hpp"
#include "process/output_folder.hpp"
#include "process/result_output.hpp"
#include "reconstruct/depth_lens.hpp"
#include "reconstruct/overlay_picture.hpp"
#include "reconstruct/reconstruct_options.hpp"
#include "reconstruct/scene_warnings.hpp"
#include "reconstruct/world_json.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/image_io.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

struct ReconstructCommand {
  fs::path dataset, workcell, folder;
  std::vector<int> images;
  ReconstructCommandOptions how;
  bool json = false, no_pictures = false;
  int threads = 0;
};

void write_overlays(const BopScene& scene, const SceneReconstruction& reconstruction,
                    const std::vector<KnownObject>& objects, const fs::path& folder,
                    const StopToken& stop) {
  const OverlayPainter painter(scene, reconstruction, objects);
  for (std::size_t i = 0; i < scene.images.size() && !stop.stop_requested(); ++i) {
    if (scene.images[i].color.empty()) continue;
    const fs::path file = folder / fmt::format("overlay_{:06}.png", scene.images[i].id);
    write_png(file, painter.paint(i));
    spdlog::info("wrote {}", file.string());
  }
}

WorldRecord record_of(const ReconstructCommand& command, const BopScene& scene,
                      const Workcell& workcell, const SceneReconstruction& reconstruction) {
  WorldRecord record{workcell.files, config_of(command.how)};
  record.config["dataset"] = command.dataset.string();
  record.config["workcell"] = command.workcell.string();
  record.config["images"] = command.images;
  for (const auto* files : {&scene.files, &reconstruction.observed.files}) {
    record.inputs.insert(record.inputs.end(), files->begin(), files->end());
  }
  return record;
}

ExitCode reconstruct_command(const ReconstructCommand& command) {
  const auto start = StopToken::Clock::now();
  InterruptibleRun run(command.threads);
  refuse_unused(command.how.no_ambiguous, command.how.method == "pnp", "--no-ambiguous",
                "--method pnp");
  SceneReconstructionOptions options = options_of(command.how);
  options.cameras_suffice = true;
  const Workcell workcell = load_workcell(command.workcell);
  BopScene scene = load_dataset(command.dataset, workcell, command.images, options.observe);
  if (workcell.depth_lens != DepthLens::unsaid) {
    apply_depth_lens(workcell.depth_lens, calibrations_of(workcell, options.observe), scene);
    options.depth_is_pinhole = true;
  }
  const double load_s = seconds_since(start);

  const SceneReconstruction reconstruction = run.execute("reconstructing", [&] {
    run.stop().expect(scene.images.size());
    return reconstruct_scene(scene, workcell, options, run.stop());
  });
  if (run.cancelled()) return ExitCode::cancelled;
  const std::vector<KnownObject> objects = known_objects(reconstruction.result);
  WorldRecord record = record_of(command, scene, workcell, reconstruction);
  record.warnings = type_warnings(workcell);
  for (const auto& more : {camera_warnings(scene, reconstruction.observed),
                           object_warnings(reconstruction.result, objects)}) {
    record.warnings.insert(record.warnings.end(), more.begin(), more.end());
  }
  for (const std::string& warning : record.warnings) spdlog::warn("{}", warning);
  record.load_s = load_s;
  record.total_s = seconds_since(start);
  const auto json = world_to_json(scene, workcell, reconstruction, objects, record);
  if (!command.folder.empty()) {
    make_output_folder(command.folder);
    write_file(command.folder / "world.json", json_text(json));
    spdlog::info("wrote {}", (command.folder / "world.json").string());
  }
  const std::optional<Error> lost =
      try_print_result(command.json, json, [&] { return summary_of_world(json); });
  if (!command.folder.empty() && !command.no_pictures) {
    run.execute(
        [&] { write_overlays(scene, reconstruction, objects, command.folder, run.stop()); });
  }
  if (lost) throw *lost;
  return run.exit_code();
}

}  // namespace

void add_reconstruct_command(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(
      "reconstruct",
      "Find the camera poses and the known objects of a recording by their features");
  const auto command = std::make_shared<ReconstructCommand>();
  verb->add_option("dataset", command->dataset,
                   "BOP scene folder, or a folder of photographs with --calibration")
      ->required();
  verb->add_option("--workcell", command->workcell,
                   "Workcell file (YAML) with knowledge_base, board or both; the board is needed "
                   "where cameras have no poses")
      ->option_text("FILE")
      ->required()
      ->group("Input");
  CLI::Option* folder = add_output_option(*verb, command->folder, "world.json and pictures");
  add_images_option(*verb, command->images);
  verb->add_option("--method", command->how.method,
                   "pnp: one pose from the pixels of all cameras; voting: combines different kinds "
                   "of features; svd: the baseline, which averages single cameras' poses")
      ->check(CLI::IsMember(kReconstructionMethods))
      ->capture_default_str()
      ->group("Known objects");
  command->how.add_to(*verb);
  verb->add_flag("--no-pictures", command->no_pictures, "Do not write overlay_*.png")
      ->needs(folder)
      ->group("Output");
  add_json_flag(*verb, command->json, "world.json");
  add_threads_option(*verb, command->threads);
  verb->footer(
      "Examples:\n"
      "  vantage reconstruct my_cell --workcell cell.yaml -o out\n"
      "  vantage reconstruct my_cell --workcell cell.yaml --cameras board --images 0,2 -o out\n"
      "  vantage reconstruct my_cell --workcell cell.yaml --features seen.jsonl --method voting -o "
      "out");
  set_action(*verb, action, command, reconstruct_command);
}

}  // namespace vantage
