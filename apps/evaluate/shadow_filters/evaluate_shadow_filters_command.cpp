#include <memory>

#include "cli/command.hpp"
#include "cli/inputs_json.hpp"
#include "cli/interruptible_run.hpp"
#include "evaluate/shadow_filters/shadow_filter_json.hpp"
#include "evaluate/shadow_filters/shadow_filter_options.hpp"
#include "process/result_output.hpp"

namespace vantage {
namespace {

constexpr const char* kFilterExamples =
    "Examples:\n"
    "  vantage evaluate shadow-filters assets/workcells/wall.yaml:side\n"
    "  vantage evaluate shadow-filters assets/workcells/bin.yaml --classified --openings 0,1,2\n"
    "  vantage evaluate shadow-filters assets/workcells/duck.yaml+ideal --offsets 0,3 --json";

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
  json["config"] = options.config();
  std::vector<std::filesystem::path> files;
  for (const PlanningCell& cell : cells) {
    files.insert(files.end(), cell.files.begin(), cell.files.end());
  }
  json["inputs"] = inputs_json(files);
  return json;
}

ExitCode evaluate(const ShadowFilterCommandOptions& given) {
  ShadowFilterCommandOptions options = given;
  options.resolve();
  const ShadowFilterOptions& settings = options.settings;
  InterruptibleRun run(options.threads);
  ShadowFilterEvaluation evaluation{settings.voxel_size_m, filters_of(settings), {}};
  const std::vector<PlanningCell> cells = run.execute([&] { return load_cells(options); });
  run.execute("evaluating", [&] {
    for (const PlanningCell& cell : cells) {
      if (run.cancelled()) return;
      evaluation.scenes.push_back(evaluate_shadow_filters(cell, settings, run.stop()));
    }
  });
  if (run.cancelled()) return ExitCode::cancelled;
  print_result(options.json, json_of(evaluation, options, cells),
               [&] { return text_of(evaluation); });
  return ExitCode::ok;
}

}  // namespace

void add_evaluate_shadow_filters(CLI::App& evaluate_verb, Action& action) {
  CLI::App* verb = evaluate_verb.add_subcommand(
      "shadow-filters",
      "Compare filters for the false shadow that noisy depth causes, on simulated workcells: "
      "precision and recall of the shadow volume against the truly hidden volume");
  const auto options = std::make_shared<ShadowFilterCommandOptions>();
  options->add_to(*verb);
  verb->footer(kFilterExamples);
  set_action(*verb, action, options, evaluate);
}

}  // namespace vantage
