#include <spdlog/spdlog.h>

#include <memory>

#include "cli/command.hpp"
#include "cli/inputs_json.hpp"
#include "cli/interruptible_run.hpp"
#include "evaluate/reasoning/reasoning_options.hpp"
#include "evaluate/reasoning/reasoning_report.hpp"
#include "process/output_folder.hpp"
#include "process/result_output.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "workcell/random_objects.hpp"

namespace vantage {
namespace {

constexpr const char* kReasoningExamples =
    "Examples:\n"
    "  vantage evaluate reasoning assets/workcells/clutter.yaml --scenes 500 --seed 1000\n"
    "  vantage evaluate reasoning assets/workcells/clutter.yaml --methods svd,pnp,voting "
    "--depth-width 0\n"
    "  vantage evaluate reasoning assets/workcells/clutter.yaml --wrong-ids 0.1 -o out";

ExitCode evaluate_scenes(const ReasoningCommandOptions& options) {
  InterruptibleRun run(options.threads);
  const ReasoningBenchmarkOptions benchmark = options.benchmark();
  Workcell workcell = load_workcell(options.workcell);
  choose_random_objects(workcell, options.objects, options.types);
  const ReasoningEvaluation evaluation =
      run.execute("reasoning", [&] { return evaluate_reasoning(workcell, benchmark, run.stop()); });
  if (evaluation.scenes == 0) return run.exit_code();
  nlohmann::ordered_json json = reasoning_to_json(evaluation);
  json["config"] = options.config();
  json["inputs"] = inputs_json(workcell.files);
  if (!options.folder.empty()) {
    make_output_folder(options.folder);
    write_file(options.folder / "reasoning.json", json_text(json));
    spdlog::info("wrote {}", (options.folder / "reasoning.json").string());
  }
  print_result(options.json, json, [&] { return table_text(reasoning_table(evaluation)); });
  return run.exit_code();
}

}  // namespace

void add_evaluate_reasoning(CLI::App& evaluate_verb, Action& action) {
  CLI::App* verb = evaluate_verb.add_subcommand("reasoning",
                                                "Weigh what is found in random simulated scenes "
                                                "with misread markers by the scene's evidence: "
                                                "phantoms and recall, by each kind of evidence");
  const auto options = std::make_shared<ReasoningCommandOptions>();
  options->add_to(*verb);
  verb->footer(kReasoningExamples);
  set_action(*verb, action, options, evaluate_scenes);
}

}  // namespace vantage
