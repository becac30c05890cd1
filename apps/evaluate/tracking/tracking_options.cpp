#include "evaluate/tracking/tracking_options.hpp"

#include <map>

#include "cli/shared_options.hpp"
#include "options/command_line.hpp"
#include "options/field_json.hpp"
#include "options/sequence_fields.hpp"

namespace vantage {
namespace {

const std::map<std::string, TemporalFilter>& filters_by_name() {
  static const std::map<std::string, TemporalFilter> filters{{"none", TemporalFilter::none},
                                                             {"features", TemporalFilter::features},
                                                             {"kalman", TemporalFilter::kalman}};
  return filters;
}

}  // namespace

FieldGroup fields_of(TrackingBenchmarkOptions& options) {
  return {"",
          "Benchmark",
          {{.key = "sequences",
            .value = &options.sequences,
            .help = "Number of random sequences",
            .option = "--sequences",
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
          {fields_of(options.sequence)}};
}

void TrackingCommandOptions::add_to(CLI::App& verb) {
  verb.add_option("workcell", workcell,
                  "Workcell file (YAML) with cameras and a knowledge base, e.g. clutter.yaml")
      ->required();
  add_output_option(verb, folder, "tracking.json");
  std::vector<std::string> names;
  for (const auto& [name, _] : filters_by_name()) names.push_back(name);
  verb.add_option("--filters", filters, "Temporal filters to compare")
      ->delimiter(',')
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  verb.add_option("--objects", objects, "Number of objects at the start")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  verb.add_option("--types", types,
                  "Their types, taken in turns, e.g. brick,ramp (default: the workcell's)")
      ->delimiter(',');
  verb.add_option("--seed", seed, "Random seed of the first sequence; the next has the next one")
      ->capture_default_str();
  TrackingBenchmarkOptions defaults;
  add_fields(verb, fields_of(defaults), given);
  verb.add_flag("--no-arm", no_arm, "No arm carries the objects and passes over the table")
      ->group("Sequence");
  add_json_flag(verb, json, "tracking.json");
  add_threads_option(verb, threads);
}

TrackingBenchmarkOptions TrackingCommandOptions::benchmark() const {
  TrackingBenchmarkOptions options;
  read_given(given, fields_of(options));
  options.seed = seed;
  options.sequence.arm = !no_arm;
  return options;
}

std::vector<TemporalFilter> TrackingCommandOptions::chosen_filters() const {
  std::vector<TemporalFilter> chosen;
  for (const std::string& name : filters) chosen.push_back(filters_by_name().at(name));
  return chosen;
}

}  // namespace vantage
