#include "evaluate/reconstruction/evaluation_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "cli/shared_options.hpp"
#include "options/command_line.hpp"
#include "options/field_json.hpp"
#include "options/unused_options.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

FieldGroup subset_fields(EvaluationCommandOptions& options) {
  bool& covering = options.settings.covering;
  return {"",
          "Evaluation",
          {{.key = "methods",
            .value = NameList{kReconstructionMethods, &options.methods},
            .help = "Methods to compare",
            .option = "--methods"},
           {.key = "sizes",
            .value = &options.sizes,
            .help = "Numbers of cameras in a subset: 3, 2-9, or 2- for two and more",
            .option = "--sizes"},
           {.key = "subsets",
            .value = choice(covering, EnumNames<bool>{{"all", false}, {"covering", true}}),
            .help = "Subsets to evaluate; covering: only those that see every object that all "
                    "cameras together see",
            .option = "--subsets"}}};
}

FieldGroup correct_fields(EvaluationCommandOptions& options) {
  return {"",
          "Evaluation",
          {{.key = "correct_diameters",
            .value = &options.settings.correct,
            .help = "An estimate is correct if its MSSD is below this share of the object's "
                    "diameter",
            .option = "--correct",
            .range = positive()}}};
}

FieldGroup perturbation_fields(EvaluationCommandOptions& options) {
  Perturbation& perturbation = options.settings.perturbation;
  return {"",
          "Perturbation",
          {{.key = "noise_px",
            .value = &perturbation.noise_px,
            .help = "Standard deviation of the noise added to detections",
            .option = "--noise-px",
            .unit = "px",
            .range = not_negative()},
           {.key = "drop",
            .value = &perturbation.drop,
            .help = "Share of the detected features to drop",
            .option = "--drop",
            .range = from_to(0, 1)},
           {.key = "wrong_ids",
            .value = &perturbation.wrong_ids,
            .help = "Share of the markers, the board's included, whose id is misread",
            .option = "--wrong-ids",
            .range = from_to(0, 1)},
           {.key = "seed",
            .value = &perturbation.seed,
            .help = "Random seed for the perturbations",
            .option = "--seed"},
           {.key = "trials",
            .value = &options.settings.trials,
            .help = "Number of random perturbations of each subset",
            .option = "--trials",
            .range = from_to(1, 100000)}}};
}

FieldGroup fields_of(EvaluationCommandOptions& options) {
  return {
      "", "", {}, {subset_fields(options), perturbation_fields(options), correct_fields(options)}};
}

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

void check_unused(const EvaluationCommandOptions& options) {
  const Perturbation& perturbation = options.settings.perturbation;
  const bool perturbed =
      perturbation.noise_px > 0 || perturbation.drop > 0 || perturbation.wrong_ids > 0;
  for (const char* key : {"seed", "trials"}) {
    refuse_unused(options.given.contains(key), perturbed, std::string("--") + key,
                  "--noise-px, --drop or --wrong-ids above 0");
  }
  refuse_unused(options.how.no_ambiguous, std::ranges::count(options.methods, "pnp") > 0,
                "--no-ambiguous", "pnp among --methods");
}

}  // namespace

void EvaluationCommandOptions::add_to(CLI::App& verb) {
  verb.add_option("dataset", dataset, "BOP scene folder")->required();
  verb.add_option("--workcell", workcell,
                  "Workcell file (YAML) with knowledge_base; for a simulated dataset its own "
                  "workcell.yaml, which holds the ground truth. For other datasets the ground "
                  "truth is scene_gt.json")
      ->option_text("FILE")
      ->required()
      ->group("Input");
  add_images_option(verb, images);
  how.add_to(verb);
  add_fields(verb, fields_of(*this), given);
  add_output_option(verb, folder, "reconstruction.json and reconstruction.svg");
  add_json_flag(verb, json, "reconstruction.json");
  add_threads_option(verb, threads);
}

void EvaluationCommandOptions::resolve() {
  read_given(given, fields_of(*this));
  check_unused(*this);
  const SceneReconstructionOptions reconstruction = options_of(how);
  settings.observe = reconstruction.observe;
  settings.reconstruct = reconstruction.options;
  read_sizes(sizes, settings);
  for (const std::string& name : methods) {
    settings.methods.push_back(reconstruction_method_of(name));
  }
}

nlohmann::ordered_json EvaluationCommandOptions::config() const {
  nlohmann::ordered_json result = config_of(how);
  result.erase("method");
  result.update(
      {{"dataset", dataset.string()}, {"workcell", workcell.string()}, {"images", images}});
  EvaluationCommandOptions described = *this;
  result.update(to_json(fields_of(described)));
  return result;
}

}  // namespace vantage
