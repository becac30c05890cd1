#include <spdlog/spdlog.h>

#include <memory>

#include "cli/command.hpp"
#include "cli/inputs_json.hpp"
#include "cli/interruptible_run.hpp"
#include "cli/shared_options.hpp"
#include "evaluate/stability/stability_report.hpp"
#include "options/command_line.hpp"
#include "options/field_json.hpp"
#include "process/output_folder.hpp"
#include "process/result_output.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "workcell/random_objects.hpp"

namespace vantage {
namespace {

struct StabilityCommand {
  std::filesystem::path workcell, folder;
  std::vector<std::string> types = {};
  int objects = 12;
  std::uint64_t seed = 1;
  nlohmann::json given = nlohmann::json::object();
  bool json = false;
  int threads = 0;
};

/// The description points into what it describes.
FieldGroup fields_of(StabilityBenchmarkOptions& options) {
  return {"",
          "Benchmark",
          {{.key = "stacks",
            .value = &options.stacks,
            .help = "Number of random stacks, half of them broken",
            .option = "--stacks",
            .range = from_to(0, 1e6)},
           {.key = "scenes",
            .value = &options.scenes,
            .help = "Number of scenes in which all objects lie on the floor",
            .option = "--scenes",
            .range = from_to(0, 1e6)},
           {.key = "sigma_px",
            .value = &options.sensor.sigma_px,
            .help = "Standard deviation of a marker's corners in the image",
            .option = "--sigma-px",
            .unit = "px",
            .range = from_to(1e-6, 100)},
           {.key = "depth_width",
            .value = &options.sensor.depth_width,
            .help = "Width of the depth images; 0: none",
            .option = "--depth-width",
            .unit = "px",
            .range = from_to(0, 16384)},
           {.key = "friction",
            .value = &options.support.friction,
            .help = "Coefficient of friction between all surfaces",
            .option = "--friction",
            .range = from_to(0, 10)}}};
}

nlohmann::ordered_json json_of(const StabilityEvaluation& evaluation,
                               const StabilityCommand& command, StabilityBenchmarkOptions options,
                               const Workcell& workcell) {
  nlohmann::ordered_json json = stability_to_json(evaluation);
  json["config"] = {{"workcell", command.workcell.string()},
                    {"types", command.types},
                    {"objects", command.objects},
                    {"seed", command.seed}};
  json["config"].update(to_json(fields_of(options)));
  json["inputs"] = inputs_json(workcell.files);
  return json;
}

ExitCode evaluate_stability_command(const StabilityCommand& command) {
  InterruptibleRun run(command.threads);
  StabilityBenchmarkOptions options;
  read_given(command.given, fields_of(options));
  options.seed = command.seed;
  Workcell workcell = load_workcell(command.workcell);
  choose_random_objects(workcell, command.objects, command.types);
  const StabilityEvaluation evaluation =
      run.execute("evaluating", [&] { return evaluate_stability(workcell, options, run.stop()); });
  const auto json = json_of(evaluation, command, options, workcell);
  if (!command.folder.empty()) {
    make_output_folder(command.folder);
    write_file(command.folder / "stability.json", json_text(json));
    spdlog::info("wrote {}", (command.folder / "stability.json").string());
  }
  print_result(command.json, json, [&] {
    std::string text;
    for (const ReportTable& table : stability_tables(evaluation)) text += table_text(table) + "\n";
    return text;
  });
  return run.exit_code();
}

}  // namespace

void add_evaluate_stability(CLI::App& evaluate_verb, Action& action) {
  CLI::App* verb = evaluate_verb.add_subcommand(
      "stability",
      "Judge whether random simulated stacks stand, half of them broken, and pull objects at rest "
      "to what they stand on: right verdicts, pose errors and covariances against the truth");
  const auto command = std::make_shared<StabilityCommand>();
  verb->add_option("workcell", command->workcell,
                   "Workcell file (YAML) with cameras and a knowledge base, e.g. clutter.yaml")
      ->required();
  add_output_option(*verb, command->folder, "stability.json");
  verb->add_option("--types", command->types,
                   "Types of the objects, e.g. brick,tin (default: the workcell's)")
      ->delimiter(',');
  verb->add_option("--objects", command->objects, "Number of objects of each scene")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  verb->add_option("--seed", command->seed, "Random seed")->capture_default_str();
  StabilityBenchmarkOptions defaults;
  add_fields(*verb, fields_of(defaults), command->given);
  add_json_flag(*verb, command->json, "stability.json");
  add_threads_option(*verb, command->threads);
  verb->footer(
      "Examples:\n"
      "  vantage evaluate stability assets/workcells/clutter.yaml\n"
      "  vantage evaluate stability assets/workcells/clutter.yaml --stacks 50 --scenes 0 "
      "--depth-width 0\n"
      "  vantage evaluate stability assets/workcells/clutter.yaml --types brick,tin -o out");
  set_action(*verb, action, command, evaluate_stability_command);
}

}  // namespace vantage
