#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>

#include "cli/command.hpp"
#include "cli/inputs_json.hpp"
#include "cli/interruptible_run.hpp"
#include "evaluate/planning/planning_benchmark.hpp"
#include "evaluate/planning/planning_json.hpp"
#include "evaluate/planning/planning_options.hpp"
#include "metrics/planning/planning_tables.hpp"
#include "options/field_json.hpp"
#include "options/unused_options.hpp"
#include "options/view_options.hpp"
#include "options/volume_fields.hpp"
#include "plan/report/plan_json.hpp"
#include "process/output_folder.hpp"
#include "process/result_output.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "version.hpp"

namespace vantage {
namespace {

constexpr const char* kPlanningExamples =
    "Examples:\n"
    "  vantage evaluate planning assets/workcells/wall.yaml:front,top -o out\n"
    "  vantage evaluate planning assets/workcells/two_pillars.yaml+noisy --methods "
    "voxel,expected,mesh\n"
    "  vantage evaluate planning assets/workcells/corridor.yaml --candidates production --json";

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kPictureWidth = 960;

/// All scenes, with what was read for them.
struct PlanningResult {
  PlanningEvaluation evaluation;
  std::vector<PagePicture> pictures;
  std::vector<PlanRequest> requests;  ///< as the workcells have them
  std::vector<fs::path> files;
};

PlanningBenchmarkOptions options_of(const PlanningCommandOptions& options) {
  PlanningBenchmarkOptions settings = options.benchmark;
  std::vector<std::string> methods = options.methods;
  const bool there = std::ranges::find(methods, "expected") != methods.end();
  if (options.value == "expected" && !there) methods.push_back("expected");
  choose(methods, options.sets, settings);
  settings.given = options.given;
  VolumeOptions volume;
  read_given(
      options.given,
      {"", "", {}, {fields_of(settings.servo), fields_of(settings.polish), fields_of(volume)}});
  refuse_unused_servo(options.given, settings.servo);
  refuse_unused_filter(options.given, volume);
  const bool drawn = !options.folder.empty() && !options.no_pictures;
  settings.picture_width = drawn ? kPictureWidth : 0;
  return settings;
}

/// All cells are loaded before the first is evaluated, so that errors are reported at once.
std::vector<PlanningCell> load_cells(const PlanningCommandOptions& options) {
  std::vector<PlanningCell> cells;
  for (const std::string& scene : options.scenes) {
    cells.push_back(
        load_planning_cell(planning_cell_name(scene), depth_kind_of(options.depth), options.seed));
  }
  return cells;
}

PlanningResult evaluate_cells(const std::vector<PlanningCell>& cells,
                              const PlanningBenchmarkOptions& settings, const StopToken& stop) {
  PlanningResult result;
  for (const NamedMethod& method : settings.methods) {
    result.evaluation.methods.push_back(method.name);
  }
  result.evaluation.servo_iterations = settings.servo.iterations;
  result.evaluation.polished_views = settings.polish.views;
  for (std::size_t i = 0; i < cells.size() && !stop.stop_requested(); ++i) {
    EvaluatedScene one = evaluate_planning(cells[i], settings, stop);
    if (stop.stop_requested()) break;  // those before it are complete
    for (PagePicture& picture : one.pictures) {
      picture.scene = i;
      result.pictures.push_back(std::move(picture));
    }
    result.evaluation.scenes.push_back(std::move(one.scene));
    result.requests.push_back(cells[i].request);
    result.files.insert(result.files.end(), cells[i].files.begin(), cells[i].files.end());
  }
  return result;
}

Json config_json(const PlanningCommandOptions& options, const PlanningBenchmarkOptions& settings) {
  return {
      {"scenes", options.scenes},
      {"depth", options.depth},
      {"seed", options.seed},
      {"candidates", settings.sets},
      {"radii_m", settings.radii_m.empty() ? Json() : Json(settings.radii_m)},
      {"servo",
       {{"iterations", settings.servo.iterations}, {"image_width", settings.servo.image_width}}},
      {"polish", {{"views", settings.polish.views}, {"image_width", settings.polish.image_width}}},
      {"voxel_size_m", settings.given.value("voxel_size_m", Json())}};
}

Json config_json(const PlanRequest& request) {
  const Json all = config_of(request);
  return {{"work_area", all["work_area"]},
          {"movable_camera", camera_json(request)},
          {"constraints", all["constraints"]},
          {"volume", all["volume"]}};
}

Json json_of(const PlanningResult& result, const PlanningCommandOptions& options,
             const PlanningBenchmarkOptions& settings) {
  Json json = planning_to_json(result.evaluation);
  for (std::size_t i = 0; i < result.requests.size(); ++i) {
    json["scenes"][i]["config"] = config_json(result.requests[i]);
  }
  Json timing = json["timing"];
  json.erase("timing");
  json["config"] = config_json(options, settings);
  json["inputs"] = inputs_json(result.files);
  json["timing"] = {{"threads", options.threads}, {"repeat", settings.repeat}};
  json["timing"].update(timing);
  return json;
}

std::vector<std::string> settings_text(const PlanningCommandOptions& options,
                                       const PlanningBenchmarkOptions& settings) {
  return {fmt::format(
      "vantage {}, servo iterations: {}, polished views: {}, {}, run times: {} of {}.", kVersion,
      settings.servo.iterations, settings.polish.views,
      options.threads > 0 ? fmt::format("{} threads", options.threads) : "one thread per core",
      settings.repeat > 1 ? "medians" : "one run", settings.repeat)};
}

void write(const PlanningCommandOptions& options, const PlanningBenchmarkOptions& settings,
           const PlanningResult& result, const Json& json) {
  const fs::path& folder = options.folder;
  make_output_folder(folder);
  write_file(folder / "planning.json", json_text(json));
  for (const std::string& set : settings.sets) {
    write_file(folder / ("planning_" + set + ".svg"), run_time_chart(result.evaluation, set));
  }
  write_file(folder / "planning.html",
             planning_page(result.evaluation, result.pictures, settings_text(options, settings)));
  spdlog::info("wrote {}, planning.json and charts", (folder / "planning.html").string());
}

std::string text_of(const PlanningEvaluation& evaluation) {
  std::string text;
  for (const SceneEvaluation& scene : evaluation.scenes) {
    for (const std::string& remark : remarks_on(scene)) text += remark + "\n\n";
  }
  for (const ReportTable& table : planning_tables(evaluation)) text += table_text(table) + "\n";
  return text;
}

ExitCode evaluate(const PlanningCommandOptions& options) {
  const PlanningBenchmarkOptions settings = options_of(options);
  InterruptibleRun run(options.threads);
  const std::vector<PlanningCell> cells = run.execute([&] { return load_cells(options); });
  const PlanningResult result =
      run.execute("evaluating", [&] { return evaluate_cells(cells, settings, run.stop()); });
  if (result.evaluation.scenes.empty()) return run.exit_code();
  Json json = json_of(result, options, settings);
  json["partial"] = run.cancelled();
  if (!options.folder.empty()) write(options, settings, result, json);
  print_result(options.json, json, [&] { return text_of(result.evaluation); });
  return run.exit_code();
}

}  // namespace

void add_evaluate_planning(CLI::App& evaluate_verb, Action& action) {
  CLI::App* verb = evaluate_verb.add_subcommand(
      "planning",
      "Repeat the thesis' chapter 9 on simulated workcells: which views the methods pick, how good "
      "they are by the voxel method and by the ground truth, and how long planning takes");
  const auto options = std::make_shared<PlanningCommandOptions>();
  options->add_to(*verb);
  verb->footer(kPlanningExamples);
  set_action(*verb, action, options, evaluate);
}

}  // namespace vantage
