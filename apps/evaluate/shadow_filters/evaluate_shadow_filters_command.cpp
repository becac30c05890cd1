#include <memory>

#include "cli/command.hpp"
#include "cli/inputs_json.hpp"
#include "cli/number_checks.hpp"
#include "cli/progress_line.hpp"
#include "cli/shared_options.hpp"
#include "cli/signal_handler.hpp"
#include "cli/workers.hpp"
#include "evaluate/shadow_filters/shadow_filter_benchmark.hpp"
#include "evaluate/shadow_filters/shadow_filter_json.hpp"
#include "process/result_output.hpp"

namespace vantage {
namespace {

constexpr const char* kFilterExamples =
    "Examples:\n"
    "  vantage evaluate shadow-filters assets/workcells/wall.yaml:side\n"
    "  vantage evaluate shadow-filters assets/workcells/bin.yaml --classified --openings 0,1,2\n"
    "  vantage evaluate shadow-filters assets/workcells/duck.yaml+ideal --offsets 0,3 --json";

struct ShadowFilterCommandOptions {
  std::vector<std::string> scenes;
  std::string holes = "fill";
  std::uint64_t seed = 0;
  ShadowFilterOptions settings;
  bool json = false;
  int threads = 0;
};

std::vector<PlanningCell> load_cells(const ShadowFilterCommandOptions& options) {
  std::vector<PlanningCell> cells;
  for (const std::string& scene : options.scenes) {
    cells.push_back(load_planning_cell(planning_cell_name(scene), DepthKind::noisy, options.seed));
  }
  return cells;
}

std::string text_of(const ShadowFilterEvaluation& evaluation) {
  std::string text;
  for (const ReportTable& table : shadow_filter_tables(evaluation)) {
    text += table_text(table) + "\n";
  }
  return text;
}

nlohmann::ordered_json json_of(const ShadowFilterEvaluation& evaluation,
                               const ShadowFilterCommandOptions& options,
                               const std::vector<PlanningCell>& cells) {
  nlohmann::ordered_json json = to_json(evaluation);
  json["config"] = {{"scenes", options.scenes},
                    {"seed", options.seed},
                    {"classified", options.settings.classified},
                    {"step_px", options.settings.step_px},
                    {"holes", options.holes}};
  std::vector<std::filesystem::path> files;
  for (const PlanningCell& cell : cells) {
    files.insert(files.end(), cell.files.begin(), cell.files.end());
  }
  json["inputs"] = inputs_json(files);
  return json;
}

ExitCode evaluate(ShadowFilterCommandOptions options) {
  const StopToken stop;
  const SignalHandler interrupt({stop});
  ShadowFilterOptions& settings = options.settings;
  settings.holes = options.holes == "fill" ? DepthHoles::fill : DepthHoles::unknown;
  ShadowFilterEvaluation evaluation{settings.voxel_size_m, filters_of(settings), {}};
  Workers workers(options.threads);
  const std::vector<PlanningCell> cells = workers.execute([&] { return load_cells(options); });
  workers.execute([&] {
    const ProgressLine progress("evaluating", stop);
    for (const PlanningCell& cell : cells) {
      if (stop.stop_requested()) return;
      evaluation.scenes.push_back(evaluate_shadow_filters(cell, settings, stop));
    }
  });
  if (stop.stop_requested()) return ExitCode::cancelled;
  print_result(options.json, json_of(evaluation, options, cells),
               [&] { return text_of(evaluation); });
  return ExitCode::ok;
}

void add_filter_options(CLI::App& verb, ShadowFilterOptions& settings) {
  verb.add_option("--offsets", settings.offsets_sigmas,
                  "How far the visibility mesh moves away from its camera, in σ of the depth's "
                  "noise, e.g. 0,1,2,3")
      ->delimiter(',')
      ->check(number_between(0.0, 1000.0))
      ->capture_default_str();
  verb.add_option("--openings", settings.openings_voxels,
                  "Radii of the shadow's morphological opening, voxels; 0: none")
      ->delimiter(',')
      ->check(CLI::Range(0, 64))
      ->capture_default_str();
  verb.add_option("--least-cm3", settings.min_cm3,
                  "Regions of shadow smaller than this are removed; 0: none")
      ->delimiter(',')
      ->check(number_between(0.0, 1e9))
      ->capture_default_str();
}

void add_mesh_options(CLI::App& verb, ShadowFilterCommandOptions& options) {
  verb.add_flag(
      "--classified", options.settings.classified,
      "Filter the voxels as planning classifies them, instead of carving the work area by "
      "visibility meshes");
  verb.add_option("--step", options.settings.step_px,
                  "Every so many pixels a vertex of the visibility mesh")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  verb.add_option("--holes", options.holes,
                  "What becomes of pixels without a depth: fill them from around, or leave them "
                  "unknown")
      ->check(CLI::IsMember({"fill", "unknown"}))
      ->capture_default_str();
  verb.add_option("--voxel-size", options.settings.voxel_size_m, "Edge of a voxel, metres")
      ->check(positive_number())
      ->capture_default_str();
}

}  // namespace

void add_evaluate_shadow_filters(CLI::App& evaluate_verb, Action& action) {
  CLI::App* verb = evaluate_verb.add_subcommand(
      "shadow-filters",
      "Compare filters for the false shadow that noisy depth causes, on simulated workcells: "
      "precision and recall of the shadow volume against the truly hidden volume");
  const auto options = std::make_shared<ShadowFilterCommandOptions>();
  verb->add_option("scenes", options->scenes,
                   "Workcell files, each with the cameras to use and their depth images: "
                   "FILE[:CAMERA,...][+ideal|+noisy], e.g. wall.yaml:side (default: noisy)")
      ->required();
  add_filter_options(*verb, options->settings);
  add_mesh_options(*verb, *options);
  verb->add_option("--seed", options->seed, "Random seed for the depth images' noise")
      ->capture_default_str();
  add_json_flag(*verb, options->json, "JSON");
  add_threads_option(*verb, options->threads);
  verb->footer(kFilterExamples);
  verb->parse_complete_callback(
      [&action, options] { action = [=] { return evaluate(*options); }; });
}

}  // namespace vantage
