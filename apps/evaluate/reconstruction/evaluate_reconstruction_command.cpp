#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <memory>

#include "cli/command.hpp"
#include "cli/inputs_json.hpp"
#include "cli/number_checks.hpp"
#include "cli/progress_line.hpp"
#include "cli/shared_options.hpp"
#include "cli/signal_handler.hpp"
#include "cli/workers.hpp"
#include "evaluate/reconstruction/evaluation_report.hpp"
#include "process/output_folder.hpp"
#include "process/result_output.hpp"
#include "reconstruct/reconstruct_options.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"
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

struct EvaluationCommandOptions {
  fs::path dataset, workcell, folder;
  std::vector<int> images;
  std::vector<std::string> methods = kReconstructionMethods;
  std::string sizes = "2-", subsets = "all";
  ReconstructCommandOptions how;
  ReconstructionEvaluationOptions settings;
  bool json = false;
  int threads = 0;
};

std::size_t number_of(std::string_view text, const std::string& all) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size() && number > 0) return number;
  throw bad_input("--sizes", fmt::format("found '{}'; expected numbers of cameras like 3, 2-9 or "
                                         "2- (two to all)",
                                         all));
}

/// "3", "2-9" or "2-".
void read_sizes(const std::string& text, ReconstructionEvaluationOptions& settings) {
  const std::size_t dash = text.find('-');
  const std::string_view view = text;
  settings.min_cameras = number_of(view.substr(0, dash), text);
  settings.max_cameras = settings.min_cameras;
  if (dash == std::string::npos) return;
  settings.max_cameras.reset();
  if (dash + 1 < text.size()) settings.max_cameras = number_of(view.substr(dash + 1), text);
}

ReconstructionEvaluationOptions options_of(const EvaluationCommandOptions& arguments) {
  ReconstructionEvaluationOptions settings = arguments.settings;
  const SceneReconstructionOptions reconstruction = options_of(arguments.how);
  settings.observe = reconstruction.observe;
  settings.reconstruct = reconstruction.options;
  settings.covering = arguments.subsets == "covering";
  read_sizes(arguments.sizes, settings);
  for (const std::string& name : arguments.methods) {
    settings.methods.push_back(reconstruction_method_of(name));
  }
  return settings;
}

Json config_json(const EvaluationCommandOptions& arguments) {
  Json config = config_of(arguments.how);
  config.erase("method");
  const ReconstructionEvaluationOptions& settings = arguments.settings;
  const Perturbation& perturbation = settings.perturbation;
  config.update({{"dataset", arguments.dataset.string()},
                 {"workcell", arguments.workcell.string()},
                 {"images", arguments.images},
                 {"methods", arguments.methods},
                 {"sizes", arguments.sizes},
                 {"subsets", arguments.subsets},
                 {"noise_px", perturbation.noise_px},
                 {"drop", perturbation.drop},
                 {"wrong_ids", perturbation.wrong_ids},
                 {"seed", perturbation.seed},
                 {"trials", settings.trials},
                 {"correct_diameters", settings.correct}});
  return config;
}

void write(const fs::path& folder, const Json& json, const std::string& plot) {
  make_output_folder(folder);
  write_file(folder / "reconstruction.json", json_text(json));
  write_file(folder / "reconstruction.svg", plot);
  spdlog::info("wrote {} and reconstruction.svg", (folder / "reconstruction.json").string());
}

ExitCode evaluate(const EvaluationCommandOptions& arguments) {
  const StopToken stop;
  const SignalHandler interrupt({stop});
  Workers workers(arguments.threads);
  const ReconstructionEvaluationOptions settings = options_of(arguments);
  Workcell workcell = load_workcell(arguments.workcell);
  place_random_objects(workcell);
  const BopScene scene =
      load_dataset(arguments.dataset, workcell, arguments.images, settings.observe);
  const ReconstructionEvaluation evaluation = workers.execute([&] {
    const ProgressLine progress("evaluating", stop);
    return evaluate_reconstruction(scene, workcell, settings, stop);
  });
  if (stop.stop_requested()) return ExitCode::cancelled;

  std::vector<fs::path> files = evaluation.files;
  files.insert(files.end(), workcell.files.begin(), workcell.files.end());
  files.insert(files.end(), scene.files.begin(), scene.files.end());
  Json json = evaluation_to_json(evaluation);
  json["config"] = config_json(arguments);
  json["inputs"] = inputs_json(files);
  if (!arguments.folder.empty()) {
    const std::string name = fs::absolute(arguments.dataset).lexically_normal().string();
    write(
        arguments.folder, json,
        plot_of_evaluation(evaluation, "Reconstruction of " + fs::path(name).filename().string()));
  }
  print_result(arguments.json, json, [&] { return summary_of_evaluation(evaluation); });
  return ExitCode::ok;
}

void add_disturbance_options(CLI::App& verb, ReconstructionEvaluationOptions& settings) {
  Perturbation& perturbation = settings.perturbation;
  verb.add_option("--noise-px", perturbation.noise_px,
                  "Standard deviation of the noise added to detections, pixels")
      ->check(number_from_zero());
  verb.add_option("--drop", perturbation.drop, "Share of the detected features to drop")
      ->check(number_between(0.0, 1.0));
  verb.add_option("--wrong-ids", perturbation.wrong_ids,
                  "Share of the markers, the board's included, whose id is misread")
      ->check(number_between(0.0, 1.0));
  verb.add_option("--seed", perturbation.seed, "Random seed for the perturbations")
      ->capture_default_str();
  verb.add_option("--trials", settings.trials, "Number of random perturbations of each subset")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
}

void add_subset_options(CLI::App& verb, EvaluationCommandOptions& arguments) {
  verb.add_option("--methods", arguments.methods, "Methods to compare, e.g. svd,pnp")
      ->delimiter(',')
      ->check(CLI::IsMember(kReconstructionMethods))
      ->capture_default_str();
  verb.add_option("--sizes", arguments.sizes,
                  "Numbers of cameras in a subset: 3, 2-9, or 2- for two and more")
      ->capture_default_str();
  verb.add_option("--subsets", arguments.subsets,
                  "Subsets to evaluate; all; covering: only those that see every object that all "
                  "cameras together see")
      ->check(CLI::IsMember({"all", "covering"}))
      ->capture_default_str();
  verb.add_option("--correct", arguments.settings.correct,
                  "An estimate is correct if its MSSD is below this share of the object's diameter")
      ->check(positive_number())
      ->capture_default_str();
}

}  // namespace

void add_evaluate_reconstruction(CLI::App& evaluate_verb, Action& action) {
  CLI::App* verb = evaluate_verb.add_subcommand(
      "reconstruction", "Compare the methods' errors over all subsets of a recording's cameras");
  const auto arguments = std::make_shared<EvaluationCommandOptions>();
  verb->add_option("dataset", arguments->dataset, "BOP scene folder")->required();
  verb->add_option("--workcell", arguments->workcell,
                   "Workcell file (YAML) with knowledge_base; for a simulated dataset its own "
                   "workcell.yaml, which holds the ground truth. For other datasets the ground "
                   "truth is scene_gt.json")
      ->required();
  add_output_option(*verb, arguments->folder, "reconstruction.json and reconstruction.svg");
  add_images_option(*verb, arguments->images);
  add_subset_options(*verb, *arguments);
  arguments->how.add_to(*verb);
  add_disturbance_options(*verb, arguments->settings);
  add_json_flag(*verb, arguments->json, "reconstruction.json");
  add_threads_option(*verb, arguments->threads);
  verb->footer(kReconstructionExamples);
  verb->parse_complete_callback(
      [&action, arguments] { action = [=] { return evaluate(*arguments); }; });
}

}  // namespace vantage
