#include <spdlog/spdlog.h>

#include <iostream>
#include <memory>

#include "cli/command.hpp"
#include "cli/inputs_json.hpp"
#include "cli/number_checks.hpp"
#include "cli/progress_line.hpp"
#include "cli/signal_handler.hpp"
#include "cli/workers.hpp"
#include "evaluate/replay/replay_benchmark.hpp"
#include "evaluate/replay/replay_json.hpp"
#include "metrics/planning/replay_tables.hpp"
#include "plan/method_options.hpp"
#include "plan/plan_options.hpp"
#include "vantage/raycore/detail/file.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct ReplayCommandOptions {
  PlanOptions plan;
  std::vector<std::string> methods{"voxel", "mesh", "meshD6"};
  MeshMethod mesh;
  ReplayBenchmarkOptions settings;
  fs::path folder;
  bool json = false;
  int threads = 0;
};

ReplayBenchmarkOptions options_of(const ReplayCommandOptions& arguments) {
  ReplayBenchmarkOptions settings = arguments.settings;
  settings.methods = named_methods(arguments.methods);
  for (NamedMethod& method : settings.methods) {
    auto* const mesh = std::get_if<MeshMethod>(&method.method);
    if (mesh == nullptr) continue;
    const MeshMethod named = *mesh;
    *mesh = arguments.mesh;
    mesh->weight = named.weight;
    mesh->depth_power = named.depth_power;
  }
  return settings;
}

Json config_json(const ReplayCommandOptions& arguments, const PlanInput& input) {
  PlanRequest request = input.request;
  request.method = arguments.mesh;
  const Json all = config_of(request);
  Json config = input.record.config;
  config.update({{"methods", arguments.methods},
                 {"pairs", arguments.settings.pairs},
                 {"seed", arguments.settings.seed},
                 {"least_seen", arguments.settings.min_seen},
                 {"work_area", all["work_area"]},
                 {"voxel_size_m", request.voxel_size_m},
                 {"volume", all["volume"]},
                 {"mesh", all["mesh"]}});
  return config;
}

std::string text_of(const ReplayEvaluation& evaluation) {
  std::string text;
  for (const ReportTable& table : replay_tables(evaluation)) {
    text += (text.empty() ? "" : "\n") + table_text(table);
  }
  return text;
}

ExitCode evaluate(const ReplayCommandOptions& arguments) {
  const StopToken stop;
  const SignalHandler interrupt({stop});
  const ReplayBenchmarkOptions settings = options_of(arguments);
  Workers workers(arguments.threads);
  PlanInput input = workers.execute([&] { return load_plan_input(arguments.plan, stop); });
  for (const std::string& warning : input.warnings) spdlog::warn("{}", warning);
  const ReplayEvaluation evaluation = workers.execute([&] {
    const ProgressLine progress("replaying", stop);
    return evaluate_replay(input, settings, stop);
  });
  if (stop.stop_requested()) return ExitCode::cancelled;
  Json json = replay_to_json(evaluation);
  json["config"] = config_json(arguments, input);
  json["inputs"] = inputs_json(input.record.inputs);
  if (!arguments.folder.empty()) {
    fs::create_directories(arguments.folder);
    write_file(arguments.folder / "replay.json", json.dump(1) + "\n");
    spdlog::info("wrote {}", (arguments.folder / "replay.json").string());
  }
  std::cout << (arguments.json ? json.dump(1) + "\n" : text_of(evaluation)) << std::flush;
  return ExitCode::ok;
}

void add_replay_options(CLI::App& verb, ReplayCommandOptions& arguments) {
  ReplayBenchmarkOptions& settings = arguments.settings;
  verb.add_option("--methods", arguments.methods,
                  "Methods, e.g. voxel,mesh,shadowD6; D and a number is the power of the depth")
      ->delimiter(',')
      ->capture_default_str();
  verb.add_option("--pairs", settings.pairs, "So many pairs of frames to plan from")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  verb.add_option("--seed", settings.seed, "Of their choice; another seed, other pairs")
      ->capture_default_str();
  verb.add_option("--least-seen", settings.min_seen,
                  "Frames of a pair show at least this share of the work area each; all others "
                  "may be picked")
      ->check(number_between(0.0, 1.0))
      ->capture_default_str();
}

}  // namespace

void add_evaluate_replay(CLI::App& evaluate_verb, Action& action) {
  CLI::App* verb = evaluate_verb.add_subcommand(
      "replay",
      "Of a recording from many known poses: plan from two frames with the others as candidates, "
      "and see what the picked frame really reveals");
  const auto arguments = std::make_shared<ReplayCommandOptions>();
  add_input_options(*verb, arguments->plan);
  add_replay_options(*verb, *arguments);
  add_mesh_options(*verb, arguments->mesh);
  add_object_options(*verb, arguments->plan.objects);
  add_volume_options(*verb, arguments->plan);
  verb->add_option("-o,--output", arguments->folder, "Folder for replay.json");
  verb->add_flag("--json", arguments->json, "Print replay.json instead of tables");
  verb->add_option("--threads", arguments->threads, "Threads to use (0: all)")
      ->check(CLI::Range(0, 1024));
  verb->parse_complete_callback(
      [&action, arguments] { action = [=] { return evaluate(*arguments); }; });
}

}  // namespace vantage
