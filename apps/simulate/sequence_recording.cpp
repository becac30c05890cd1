#include "simulate/sequence_recording.hpp"

#include <fmt/format.h>

#include "process/output_folder.hpp"
#include "process/result_output.hpp"
#include "simulate/sequence_scenes.hpp"
#include "simulator/scene/sample_hash.hpp"
#include "vantage/raycore/detail/file.hpp"

namespace vantage {
namespace {

/// One instant. Cameras that are in step share a scene.
bool record_instant(const Workcell& workcell, const SequencePlan& plan, int instant,
                    SequenceScenes& scenes, const std::vector<BopModel>& models,
                    const RecordingOptions& options, const std::filesystem::path& folder,
                    const StopToken& stop) {
  std::map<double, SceneAtTime> by_time;
  std::vector<RecordedScene> recorded;
  for (std::size_t c = 0; c < workcell.cameras.size(); ++c) {
    const double time_s = plan.time_s(instant) + plan.delay_s(c);
    auto found = by_time.find(time_s);
    if (found == by_time.end()) found = by_time.emplace(time_s, scenes.at(time_s)).first;
    recorded.push_back({&found->second.scene, found->second.known_objects});
  }
  return record_images(workcell.cameras, recorded, models, options,
                       sample_hash(options.seed, instant), folder / instant_folder(instant), stop);
}

}  // namespace

std::string instant_folder(int instant) {
  return fmt::format("{:06}", instant);
}

bool record_sequence(const Workcell& workcell, const SequencePlan& plan,
                     const RecordingOptions& options, const std::filesystem::path& folder,
                     const StopToken& stop) {
  check_recording(workcell, options);
  make_output_folder(folder / "models");
  const std::vector<BopModel> models = bop_models(workcell);
  write_bop_models(folder / "models", models);
  write_calibrations(workcell, options, folder);
  SequenceScenes scenes(workcell, plan);
  stop.expect(workcell.cameras.size() * std::uint64_t(plan.instants));
  for (int i = 0; i < plan.instants; ++i) {
    if (!record_instant(workcell, plan, i, scenes, models, options, folder, stop)) return false;
  }
  write_file(folder / "sequence.json", json_text(sequence_to_json(plan, workcell)));
  return true;
}

}  // namespace vantage
