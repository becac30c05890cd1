#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <set>

#include "cli/command.hpp"
#include "cli/inputs_json.hpp"
#include "cli/interruptible_run.hpp"
#include "cli/number_checks.hpp"
#include "cli/shared_options.hpp"
#include "options/command_line.hpp"
#include "options/field_json.hpp"
#include "process/output_folder.hpp"
#include "process/result_output.hpp"
#include "reconstruct/overlay_picture.hpp"
#include "reconstruct/reconstruct_options.hpp"
#include "reconstruct/world_json.hpp"
#include "track/sequence_input.hpp"
#include "track/track_json.hpp"
#include "track/track_options.hpp"
#include "track/tracked_cameras.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/image_io.hpp"
#include "version.hpp"

namespace vantage {
namespace {

constexpr const char* kTrackExamples =
    "Examples:\n"
    "  vantage track my_sequence --workcell cell.yaml -o out\n"
    "  vantage track my_sequence --workcell cell.yaml --period-s 0.5 --filter features -o out\n"
    "  vantage plan my_sequence/000042 --workcell cell.yaml --objects out/000042/world.json";

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct TrackCommand {
  fs::path sequence, workcell, folder;
  ReconstructCommandOptions how;
  nlohmann::json given = nlohmann::json::object();  ///< fields of tracking
  double period_s = 0.1;
  bool json = false, no_pictures = false;
  int threads = 0;
};

/// Follows the objects of one sequence, and writes each instant's results.
class SequenceRun {
 public:
  SequenceRun(const TrackCommand& command, InterruptibleRun& run)
      : command_(command),
        run_(run),
        how_(options_of(command.how)),
        workcell_(load_workcell(command.workcell)) {
    read_given(command.given, fields_of(options_));
    options_.reconstruct = how_.options;
    check_knowledge(workcell_, false);
  }

  /// @returns track.json, of what there was until the run was cancelled.
  Json track_all(const std::vector<SequenceInstant>& instants) {
    run_.execute("tracking", [&] {
      run_.stop().expect(instants.size());
      for (const SequenceInstant& instant : instants) {
        if (run_.cancelled()) return;
        track(instant);
        run_.stop().advance(1);
      }
    });
    Json config = config_of(command_.how);
    config.update(to_json(fields_of(options_)));
    config.update({{"sequence", command_.sequence.string()},
                   {"workcell", command_.workcell.string()},
                   {"period_s", command_.period_s}});
    return {{"vantage", kVersion},   {"partial", run_.cancelled()},
            {"instants", instants_}, {"events", events_},
            {"config", config},      {"inputs", inputs_json(files_)}};
  }

 private:
  void track(const SequenceInstant& instant) {
    const BopScene scene = load_dataset(instant.folder, workcell_, instant.images, how_.observe);
    if (images_ == 0) images_ = scene.images.size();
    if (scene.images.size() != images_) {
      throw bad_input(instant.folder.string(),
                      fmt::format("found {} images; expected {}, one by each camera, as before",
                                  scene.images.size(), images_));
    }
    SceneReconstruction seen{observe(scene, workcell_, how_.observe, run_.stop()), {}, 0};
    if (run_.cancelled()) return;
    for (const std::string& warning : cameras_.apply(scene, seen.observed)) {
      spdlog::warn("{}: {}", instant.folder.string(), warning);
    }
    check_cameras(scene, seen.observed);
    const std::vector<CameraView>& views = seen.observed.views;
    SceneKnowledge knowledge = scene_knowledge(workcell_, seen.observed);
    knowledge.depth =
        depth_cameras(scene, seen.observed, workcell_.depth_lens == DepthLens::pinhole);
    if (!tracker_) {
      tracker_ = std::make_unique<ObjectTracker>(workcell_.knowledge,
                                                 SceneKnowledge{knowledge.solids}, options_);
    }
    Reconstruction snapshot =
        reconstruct(how_.method, views, *workcell_.knowledge, how_.options, run_.stop());
    reject_contradicted(views, knowledge, snapshot);
    warn_of_motion(views, *workcell_.knowledge, how_.options, run_.stop(), snapshot);
    if (run_.cancelled()) return;
    const TrackedScene tracked =
        tracker_->update({instant.time_s, views, knowledge.depth}, std::move(snapshot));
    record(instant, scene, tracked);
    if (!command_.folder.empty()) write(instant, scene, tracked, std::move(seen));
  }

  void record(const SequenceInstant& instant, const BopScene& scene, const TrackedScene& tracked) {
    instants_.push_back(instant_json(instant.folder.filename().string(), tracked));
    for (const TrackEvent& event : tracked.events) events_.push_back(to_json(event));
    files_.insert(files_.end(), scene.files.begin(), scene.files.end());
  }

  void write(const SequenceInstant& instant, const BopScene& scene, const TrackedScene& tracked,
             SceneReconstruction seen) {
    const fs::path folder = command_.folder / instant.folder.filename();
    seen.result = as_reconstruction(tracked);
    const std::vector<KnownObject> objects = named_objects(tracked);
    WorldRecord record{scene.files, config_of(command_.how)};
    Json world = world_to_json(scene, workcell_, seen, objects, record);
    add_tracking(tracked, world);
    make_output_folder(folder);
    write_file(folder / "world.json", json_text(world));
    if (command_.no_pictures) return;
    const OverlayPainter painter(scene, seen, objects);
    for (std::size_t i = 0; i < scene.images.size(); ++i) {
      if (scene.images[i].color.empty()) continue;
      write_png(folder / fmt::format("overlay_{:06}.png", scene.images[i].id), painter.paint(i));
    }
  }

  const TrackCommand& command_;
  InterruptibleRun& run_;
  SceneReconstructionOptions how_;
  Workcell workcell_;
  TrackOptions options_;
  TrackedCameras cameras_;
  std::size_t images_ = 0;  // of each instant
  std::unique_ptr<ObjectTracker> tracker_;
  Json instants_ = Json::array(), events_ = Json::array();
  std::vector<fs::path> files_ = workcell_.files;
};

void write_events(const fs::path& folder, const Json& track) {
  std::string lines;
  for (const Json& event : track["events"]) {
    lines += event.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  }
  write_file(folder / "events.jsonl", lines);
  write_file(folder / "track.json", json_text(track));
  spdlog::info("wrote {} and track.json", (folder / "events.jsonl").string());
}

ExitCode track_command(const TrackCommand& command) {
  InterruptibleRun run(command.threads);
  SequenceRun sequence(command, run);
  const std::vector<SequenceInstant> instants = read_sequence(command.sequence, command.period_s);
  if (!command.folder.empty()) make_output_folder(command.folder);
  const Json track = sequence.track_all(instants);
  if (!command.folder.empty()) write_events(command.folder, track);
  print_result(command.json, track, [&] { return summary_of_track(track); });
  return run.exit_code();
}

}  // namespace

void add_track_command(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(
      "track", "Follow the known objects of a recording over time: ids, filtered poses, events");
  const auto command = std::make_shared<TrackCommand>();
  verb->add_option("sequence", command->sequence,
                   "Folder with a BOP scene folder for each instant (000000, 000001, …), or with a "
                   "sequence.json")
      ->required();
  verb->add_option("--workcell", command->workcell,
                   "Workcell file (YAML) with knowledge_base; and with board, where cameras have "
                   "no poses")
      ->option_text("FILE")
      ->required()
      ->group("Input");
  CLI::Option* folder = add_output_option(
      *verb, command->folder, "events.jsonl, track.json, and world.json and pictures per instant");
  verb->add_option("--period-s", command->period_s,
                   "Time from one numbered folder to the next, without a sequence.json")
      ->check(positive_number())
      ->capture_default_str()
      ->group("Input");
  TrackOptions defaults;
  add_fields(*verb, fields_of(defaults), command->given);
  verb->add_option("--method", command->how.method, "How each instant is reconstructed")
      ->check(CLI::IsMember(kReconstructionMethods))
      ->capture_default_str()
      ->group("Known objects");
  command->how.add_to(*verb);
  verb->add_flag("--no-pictures", command->no_pictures, "Do not write overlay_*.png")
      ->needs(folder)
      ->group("Output");
  add_json_flag(*verb, command->json, "track.json");
  add_threads_option(*verb, command->threads);
  verb->footer(kTrackExamples);
  set_action(*verb, action, command, track_command);
}

}  // namespace vantage
