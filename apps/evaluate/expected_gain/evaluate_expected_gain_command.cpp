#include <memory>

#include "cli/command.hpp"
#include "cli/interruptible_run.hpp"
#include "cli/shared_options.hpp"
#include "evaluate/expected_gain/gain_summary.hpp"
#include "evaluate/expected_gain/random_cell.hpp"
#include "options/command_line.hpp"
#include "options/field_json.hpp"
#include "options/unused_options.hpp"
#include "options/view_options.hpp"
#include "options/volume_fields.hpp"
#include "process/result_output.hpp"
#include "vantage/raycore/error.hpp"
#include "version.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kExpectedGainExamples =
    "Examples:\n"
    "  vantage evaluate expected-gain assets/workcells/bin.yaml assets/workcells/duck.yaml\n"
    "  vantage evaluate expected-gain --random 200 --seed 1000 --methods expected,bound,mesh\n"
    "  vantage evaluate expected-gain --random 50 --filter off --no-oracle --json";

struct ExpectedGainCommandOptions {
  std::vector<std::string> cells;
  int random = 0;
  std::uint64_t seed = 0;
  std::vector<std::string> methods{"expected", "bound"};
  bool no_oracle = false;
  bool json = false;
  int threads = 0;
  nlohmann::json given = nlohmann::json::object();
};

Json to_json(const GainedView& view) {
  return {{"name", view.name},
          {"promised_m3", view.promised_m3},
          {"expected_m3", view.expected.expected_m3},
          {"interval_m3", {view.expected.low_m3, view.expected.high_m3}},
          {"true_gain_m3", view.gained_m3}};
}

Json to_json(const CellGains& cell) {
  Json picks = Json::array(), candidates = Json::array();
  for (const GainedView& view : cell.picks) picks.push_back(to_json(view));
  for (const GainedView& view : cell.candidates) candidates.push_back(to_json(view));
  return {{"name", cell.name},
          {"shadow_m3", cell.shadow_m3},
          {"false_shadow_m3", cell.false_shadow_m3},
          {"best_true_gain_m3", cell.best_gain_m3()},
          {"views", picks},
          {"candidates", candidates}};
}

Json to_json(const GainSummary& sum) {
  return {{"method", sum.method},
          {"cells", sum.cells},
          {"median_gained_of_expected", sum.median_ratio},
          {"share_within", sum.within},
          {"share_covered", sum.covered},
          {"mean_share_of_best", sum.share_of_best},
          {"min_share_of_best", sum.min_share_of_best}};
}

Json json_of(const std::vector<CellGains>& cells) {
  Json all = Json::array(), means = Json::array();
  for (const CellGains& cell : cells) all.push_back(to_json(cell));
  for (const GainSummary& sum : gain_summaries(cells)) means.push_back(to_json(sum));
  return {{"vantage", kVersion}, {"methods", means}, {"cells", all}};
}

PlanningCell cell_number(const ExpectedGainCommandOptions& options, std::size_t i) {
  PlanningCell cell =
      i < options.cells.size()
          ? load_planning_cell(planning_cell_name(options.cells[i]), DepthKind::noisy, options.seed)
          : random_planning_cell(options.seed + i - options.cells.size());
  ViewOptions views;
  views.sensor = cell.request.gain.sensor;
  read_given(options.given,
             {"", "", {}, {fields_of(cell.request.volume), expected_gain_fields(views)}});
  cell.request.gain = {views.ideal_sensor ? StereoSensor::ideal() : views.sensor,
                       views.unknown_depth};
  return cell;
}

void check_unused(const ExpectedGainCommandOptions& options) {
  VolumeOptions volume;
  read_given(options.given, {"", "", {}, {fields_of(volume)}});
  refuse_unused_filter(options.given, volume);
}

/// What was finished before a stop is still reported.
ExitCode evaluate(const ExpectedGainCommandOptions& options) {
  InterruptibleRun run(options.threads);
  check_unused(options);
  std::vector<GainMethod> methods;
  for (const std::string& name : options.methods) methods.push_back(gain_method(name));
  const std::size_t count = options.cells.size() + std::size_t(options.random);
  if (count == 0)
    throw bad_input("cells", "there are no cells; name workcells, or give --random N");
  std::vector<CellGains> cells;
  run.execute("evaluating", [&] {
    run.stop().expect(count);
    for (std::size_t i = 0; i < count && !run.cancelled(); ++i) {
      CellGains gains =
          evaluate_expected_gain(cell_number(options, i), methods, !options.no_oracle, StopToken());
      cells.push_back(std::move(gains));
      run.stop().advance(1);
    }
  });
  print_result(options.json, json_of(cells), [&] {
    std::string text;
    for (const ReportTable& table : gain_tables(cells)) text += table_text(table) + "\n";
    return text;
  });
  return run.exit_code();
}

}  // namespace

void add_evaluate_expected_gain(CLI::App& evaluate_verb, Action& action) {
  CLI::App* verb = evaluate_verb.add_subcommand(
      "expected-gain",
      "Compare what the methods' picks are expected to gain with what they really gain in "
      "simulated cells, shipped and random ones, and with the best candidate");
  const auto options = std::make_shared<ExpectedGainCommandOptions>();
  verb->add_option("cells", options->cells,
                   "Workcell files, each with the cameras to use and their depth images: "
                   "FILE[:CAMERA,...][+ideal|+noisy], e.g. wall.yaml:side (default: noisy)");
  verb->add_option(
          "--random", options->random,
          "Number of additional random cells: clutter and bins, known and unknown objects, with "
          "and without floor and walls, one to four cameras, different sensors")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  verb->add_option("--seed", options->seed, "Random seed for the cells and for the cameras' noise")
      ->capture_default_str();
  verb->add_option("--methods", options->methods,
                   "Methods to compare: expected and bound (method voxel with that --value), mesh, "
                   "shadow, shadowD3, light")
      ->delimiter(',')
      ->capture_default_str();
  verb->add_flag("--no-oracle", options->no_oracle,
                 "Do not measure every feasible candidate: faster, but without a comparison with "
                 "the best one");
  VolumeOptions volume;
  ViewOptions views;
  add_fields(*verb, {"", "Planning", {}, {fields_of(volume), expected_gain_fields(views)}},
             options->given);
  add_json_flag(*verb, options->json, "JSON");
  add_threads_option(*verb, options->threads);
  verb->footer(kExpectedGainExamples);
  set_action(*verb, action, options, evaluate);
}

}  // namespace vantage
