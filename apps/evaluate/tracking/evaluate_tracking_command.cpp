#include <spdlog/spdlog.h>

#include <memory>

#include "cli/command.hpp"
#include "cli/inputs_json.hpp"
#include "cli/progress_line.hpp"
#include "cli/signal_handler.hpp"
#include "cli/workers.hpp"
#include "evaluate/tracking/tracking_options.hpp"
#include "evaluate/tracking/tracking_report.hpp"
#include "options/field_json.hpp"
#include "process/output_folder.hpp"
#include "process/result_output.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "workcell/random_objects.hpp"

namespace vantage {
namespace {

constexpr const char* kTrackingExamples =
    "Examples:\n"
    "  vantage evaluate tracking assets/workcells/clutter.yaml --types "
    "bracket,ramp,brick,red_cube\n"
    "  vantage evaluate tracking assets/workcells/clutter.yaml --sequences 4 --filters kalman\n"
    "  vantage evaluate tracking assets/workcells/clutter.yaml --added 2 --taken-away 2 -o out";

nlohmann::ordered_json config_json(const TrackingCommandOptions& options,
                                   TrackingBenchmarkOptions benchmark) {
  nlohmann::ordered_json config{{"workcell", options.workcell.string()},
                                {"filters", options.filters},
                                {"objects", options.objects},
                                {"types", options.types},
                                {"seed", options.seed}};
  config.update(to_json(fields_of(benchmark)));
  return config;
}

std::string text_of(const TrackingEvaluation& evaluation) {
  std::string text;
  for (const ReportTable& table : tracking_tables(evaluation)) text += table_text(table) + "\n";
  return text;
}

ExitCode evaluate(const TrackingCommandOptions& options) {
  const StopToken stop;
  const SignalHandler interrupt({stop});
  Workers workers(options.threads);
  const TrackingBenchmarkOptions benchmark = options.benchmark();
  Workcell workcell = load_workcell(options.workcell);
  choose_random_objects(workcell, options.objects, options.types);
  const std::vector<EvaluatedTracker> trackers = object_trackers(options.chosen_filters());
  const TrackingEvaluation evaluation = workers.execute([&] {
    const ProgressLine progress("tracking", stop);
    return evaluate_tracking(workcell, trackers, benchmark, stop);
  });
  const ExitCode exit_code = evaluation.partial ? ExitCode::cancelled : ExitCode::ok;
  if (evaluation.sequences == 0) return exit_code;
  nlohmann::ordered_json json = tracking_to_json(evaluation);
  json["config"] = config_json(options, benchmark);
  json["inputs"] = inputs_json(workcell.files);
  if (!options.folder.empty()) {
    make_output_folder(options.folder);
    write_file(options.folder / "tracking.json", json_text(json));
    spdlog::info("wrote {}", (options.folder / "tracking.json").string());
  }
  print_result(options.json, json, [&] { return text_of(evaluation); });
  return exit_code;
}

}  // namespace

void add_evaluate_tracking(CLI::App& evaluate_verb, Action& action) {
  CLI::App* verb = evaluate_verb.add_subcommand(
      "tracking",
      "Follow objects over random simulated sequences: ids, events, steadiness of poses and their "
      "covariances, against the truth and beside each snapshot alone");
  const auto options = std::make_shared<TrackingCommandOptions>();
  options->add_to(*verb);
  verb->footer(kTrackingExamples);
  verb->parse_complete_callback(
      [&action, options] { action = [=] { return evaluate(*options); }; });
}

}  // namespace vantage
