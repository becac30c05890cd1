#include <spdlog/spdlog.h>

#include <memory>

#include "cli/command.hpp"
#include "cli/inputs_json.hpp"
#include "cli/interruptible_run.hpp"
#include "evaluate/reconstruction/evaluation_options.hpp"
#include "evaluate/reconstruction/evaluation_report.hpp"
#include "process/output_folder.hpp"
#include "process/result_output.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "workcell/random_objects.hpp"

namespace vantage {
namespace {

constexpr const char* kReconstructionExamples =
    "Examples:\n"
    "  vantage evaluate reconstruction castle --workcell castle/workcell.yaml -o out\n"
    "  vantage evaluate reconstruction castle --workcell castle/workcell.yaml --sizes 2-4 "
    "--methods pnp\n"
    "  vantage evaluate reconstruction castle --workcell castle/workcell.yaml --noise-px 0.5 "
    "--trials 20";

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void write(const fs::path& folder, const Json& json, const std::string& plot) {
  make_output_folder(folder);
  write_file(folder / "reconstruction.json", json_text(json));
  write_file(folder / "reconstruction.svg", plot);
  spdlog::info("wrote {} and reconstruction.svg", (folder / "reconstruction.json").string());
}

ExitCode evaluate(const EvaluationCommandOptions& given) {
  EvaluationCommandOptions options = given;
  options.resolve();
  InterruptibleRun run(options.threads);
  Workcell workcell = load_workcell(options.workcell);
  place_random_objects(workcell);
  const BopScene scene =
      load_dataset(options.dataset, workcell, options.images, options.settings.observe);
  const ReconstructionEvaluation evaluation = run.execute("evaluating", [&] {
    return evaluate_reconstruction(scene, workcell, options.settings, run.stop());
  });
  if (run.cancelled()) return ExitCode::cancelled;

  std::vector<fs::path> files = evaluation.files;
  files.insert(files.end(), workcell.files.begin(), workcell.files.end());
  files.insert(files.end(), scene.files.begin(), scene.files.end());
  Json json = evaluation_to_json(evaluation);
  json["config"] = options.config();
  json["inputs"] = inputs_json(files);
  if (!options.folder.empty()) {
    const std::string name = fs::absolute(options.dataset).lexically_normal().string();
    write(
        options.folder, json,
        plot_of_evaluation(evaluation, "Reconstruction of " + fs::path(name).filename().string()));
  }
  print_result(options.json, json, [&] { return summary_of_evaluation(evaluation); });
  return ExitCode::ok;
}

}  // namespace

void add_evaluate_reconstruction(CLI::App& evaluate_verb, Action& action) {
  CLI::App* verb = evaluate_verb.add_subcommand(
      "reconstruction", "Compare the methods' errors over all subsets of a recording's cameras");
  const auto options = std::make_shared<EvaluationCommandOptions>();
  options->add_to(*verb);
  verb->footer(kReconstructionExamples);
  set_action(*verb, action, options, evaluate);
}

}  // namespace vantage
