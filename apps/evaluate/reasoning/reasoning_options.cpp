#include "evaluate/reasoning/reasoning_options.hpp"

#include "cli/shared_options.hpp"
#include "options/command_line.hpp"
#include "options/field.hpp"
#include "options/field_json.hpp"

namespace vantage {
namespace {

FieldGroup reasoning_fields(ReasoningBenchmarkOptions& options) {
  return {"",
          "Benchmark",
          {{.key = "scenes",
            .value = &options.scenes,
            .help = "Number of random scenes",
            .option = "--scenes",
            .range = from_to(1, 1e5)},
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
           {.key = "drop",
            .value = &options.perturbation.drop,
            .help = "Share of the detected features to drop",
            .option = "--drop",
            .range = from_to(0, 1)},
           {.key = "wrong_ids",
            .value = &options.perturbation.wrong_ids,
            .help = "Share of the markers whose id is misread",
            .option = "--wrong-ids",
            .range = from_to(0, 1)}},
          {}};
}

}  // namespace

void ReasoningCommandOptions::add_to(CLI::App& verb) {
  verb.add_option("workcell", workcell,
                  "Workcell file (YAML) with cameras and a knowledge base, e.g. clutter.yaml")
      ->required();
  add_output_option(verb, folder, "reasoning.json");
  verb.add_option("--methods", methods, "Methods of reconstruction to compare")
      ->delimiter(',')
      ->check(CLI::IsMember(kReconstructionMethods))
      ->capture_default_str();
  verb.add_option("--objects", objects, "Number of objects in each scene")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  verb.add_option("--types", types,
                  "Their types, taken in turns, e.g. brick,ramp (default: the workcell's)")
      ->delimiter(',');
  verb.add_option("--seed", seed, "Random seed of the first scene; the next has the next one")
      ->capture_default_str();
  ReasoningBenchmarkOptions defaults;
  add_fields(verb, reasoning_fields(defaults), given);
  add_json_flag(verb, json, "reasoning.json");
  add_threads_option(verb, threads);
}

ReasoningBenchmarkOptions ReasoningCommandOptions::benchmark() const {
  ReasoningBenchmarkOptions options;
  read_given(given, reasoning_fields(options));
  options.seed = seed;
  options.methods.clear();
  for (const std::string& name : methods) {
    options.methods.push_back(reconstruction_method_of(name));
  }
  return options;
}

nlohmann::ordered_json ReasoningCommandOptions::config() const {
  ReasoningBenchmarkOptions options = benchmark();
  nlohmann::ordered_json config{{"workcell", workcell.string()},
                                {"methods", methods},
                                {"objects", objects},
                                {"types", types},
                                {"seed", seed}};
  config.update(to_json(reasoning_fields(options)));
  return config;
}

}  // namespace vantage
