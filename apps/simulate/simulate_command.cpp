#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "cli/command.hpp"
#include "cli/help_formatter.hpp"
#include "cli/interruptible_run.hpp"
#include "cli/number_checks.hpp"
#include "cli/shared_options.hpp"
#include "options/command_line.hpp"
#include "options/field_json.hpp"
#include "options/sensor_fields.hpp"
#include "options/sequence_fields.hpp"
#include "options/unused_options.hpp"
#include "process/result_output.hpp"
#include "simulate/sequence_recording.hpp"
#include "simulate/simulated_dataset.hpp"
#include "simulate/simulation_record.hpp"
#include "vantage/raycore/error.hpp"
#include "workcell/sequence/sequence_scene.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

struct SimulateOptions {
  fs::path workcell, folder;
  SimulationOptions settings;
  bool ideal_depth = false, no_second_imager = false, no_projector = false;
  std::optional<double> max_incidence_deg;
  nlohmann::json given = nlohmann::json::object();  // fields of the sensors
  nlohmann::json given_sequence = nlohmann::json::object();
  std::vector<std::string> delays;
  bool sequence = false, no_arm = false;
  std::vector<double> distortion, fisheye;
  bool json = false;
  int threads = 0;
};

void add_random_options(CLI::App& verb, SimulateOptions& a) {
  SimulationOptions& s = a.settings;
  verb.add_option("--seed", s.seed, "Random seed for the noise and the random objects");
  verb.add_option("--objects", s.objects,
                  "Number of objects to lay on the board at random, instead of the workcell's "
                  "random_objects")
      ->check(CLI::Range(0, 10000));
  verb.add_option("--types", s.types,
                  "Types of the random objects, taken in turn, e.g. red_cube,duck; a parent in the "
                  "hierarchy, e.g. cube, stands for all types below it")
      ->delimiter(',');
}

void add_color_options(CLI::App& verb, SimulateOptions& a) {
  ColorSensor color;
  add_fields(verb, {"", "Colour images", {}, {fields_of(color)}}, a.given);
  verb.add_option("--distortion", a.distortion,
                  "Brown-Conrady distortion of the colour lens (default: none)")
      ->option_text("K1 K2 P1 P2 K3")
      ->expected(5)
      ->group("Colour images");
  verb.add_option("--fisheye", a.fisheye, "A fisheye colour lens, as cv::fisheye has it")
      ->option_text("K1 K2 K3 K4")
      ->expected(4)
      ->excludes("--distortion")
      ->group("Colour images");
}

void add_depth_options(CLI::App& verb, SimulateOptions& a) {
  const char* heading = "Depth images";
  StereoSensor depth;
  double depth_scale_mm = RecordingOptions().depth_scale_mm;
  add_fields(verb, {"", heading, {depth_scale_field(depth_scale_mm)}, {fields_of(depth)}}, a.given);
  verb.add_flag("--no-second-imager", a.no_second_imager,
                "Measure depth also where the second imager cannot see the surface")
      ->group(expert_group(heading));
  verb.add_flag("--no-projector", a.no_projector,
                "Measure depth also where the projector's light does not reach")
      ->group(expert_group(heading));
  verb.add_option("--max-incidence-deg", a.max_incidence_deg,
                  "Largest angle between a surface's normal and the ray that still gets a depth; "
                  "90: no limit (default: 80)")
      ->check(number_between(1.0, 90.0))
      ->group(expert_group(heading));
  CLI::Option* ideal = verb.add_flag("--ideal-depth", a.ideal_depth,
                                     "Measure every surface exactly: none of the effects above")
                           ->group(heading);
  for (const char* effect :
       {"--depth-noise-px", "--disparity-step-px", "--max-disparity-px", "--max-incidence-deg",
        "--border-px", "--flying-pixels", "--no-second-imager", "--no-projector"}) {
    ideal->excludes(effect);
  }
}

void add_sequence_options(CLI::App& verb, SimulateOptions& a) {
  RandomSequence defaults;
  verb.add_flag("--sequence", a.sequence,
                "Record over time, as the workcell's sequence says; the options below do so, too")
      ->group("Sequence");
  FieldGroup group = fields_of(defaults);
  group.key.clear();
  add_fields(verb, group, a.given_sequence);
  verb.add_flag("--no-arm", a.no_arm, "No arm carries the objects and passes over the table")
      ->group(group.heading);
  verb.add_option(
          "--delay", a.delays,
          "A camera that is out of step: CAMERA=SECONDS, so much later it takes its picture")
      ->group(group.heading);
}

/// "back=0.03".
void read_delay(const std::string& text, std::map<std::string, double>& delays_s) {
  const std::size_t mark = text.rfind('=');
  double delay_s = 0;
  if (mark != std::string::npos && mark > 0) {
    const char* const begin = text.data() + mark + 1;
    const char* const end = text.data() + text.size();
    const auto [last, error] = std::from_chars(begin, end, delay_s);
    if (error == std::errc() && last == end && begin != end && std::isfinite(delay_s)) {
      delays_s[text.substr(0, mark)] = delay_s;
      return;
    }
  }
  throw bad_input("--delay",
                  fmt::format("found '{}'; expected CAMERA=SECONDS, e.g. back=0.03", text));
}

/// What the workcell says, and the command line's options on top; nothing for a single instant.
std::optional<SequenceSettings> sequence_of(const SimulateOptions& a, const Workcell& workcell) {
  const bool asked = a.sequence || !a.given_sequence.empty() || !a.delays.empty() || a.no_arm;
  if (!asked) return {};
  SequenceSettings settings = workcell.sequence.value_or(SequenceSettings{});
  FieldGroup group = fields_of(settings.random);
  group.key.clear();
  read_given(a.given_sequence, group);
  if (a.no_arm) settings.random.arm = false;
  for (const std::string& delay : a.delays) read_delay(delay, settings.delays_s);
  return settings;
}

std::optional<SequencePlan> plan_of(const SimulateOptions& a, const Workcell& workcell,
                                    const RecordingOptions& recording) {
  const std::optional<SequenceSettings> sequence = sequence_of(a, workcell);
  if (!sequence) return {};
  return plan_sequence(sequence_scene(workcell, recording.color.distortion), *sequence,
                       recording.seed);
}

/// The command line's flags on top of the workcell's sensor.
RecordingOptions recording_of(const SimulateOptions& a, const Workcell& workcell) {
  RecordingOptions recording = a.settings.recording;
  StereoSensor& depth = recording.depth;
  depth.noise = workcell.volume.noise;
  if (a.ideal_depth) depth = StereoSensor::ideal();
  read_given(a.given, {"",
                       "",
                       {depth_scale_field(recording.depth_scale_mm)},
                       {fields_of(recording.color), fields_of(depth)}});
  if (a.no_second_imager) depth.second_imager = false;
  if (a.no_projector) depth.projector = false;
  if (a.max_incidence_deg) {
    depth.max_incidence_rad = *a.max_incidence_deg * std::numbers::pi / 180;
  }
  if (!a.distortion.empty()) {
    const double* d = a.distortion.data();
    recording.color.distortion = {d[0], d[1], d[2], d[3], d[4]};
  }
  if (!a.fisheye.empty()) {
    const double* d = a.fisheye.data();
    recording.color.distortion = Distortion::fisheye(d[0], d[1], d[2], d[3]);
  }
  return recording;
}

ExitCode simulate(const SimulateOptions& options) {
  InterruptibleRun run(options.threads);
  Workcell workcell = load_workcell(options.workcell);
  SimulationOptions settings = options.settings;
  settings.recording = recording_of(options, workcell);
  refuse_unused(!settings.types.empty(),
                settings.objects.has_value() || workcell.random_objects.has_value(), "--types",
                "--objects N, or random_objects in the workcell");
  prepare_objects(workcell, settings);
  check_recording(workcell, settings.recording);
  const std::optional<SequencePlan> plan =
      run.execute([&] { return plan_of(options, workcell, settings.recording); });
  claim_folder(options.folder);
  const bool complete = run.execute("recording", [&] {
    const SimulatedCell cell = simulated_cell(workcell);
    const auto json =
        write_simulation_record(options.workcell, workcell, cell, settings, options.folder);
    const bool recorded =
        plan ? record_sequence(workcell, *plan, settings.recording, options.folder, run.stop())
             : record(workcell, cell, settings.recording, options.folder, run.stop());
    if (!recorded) return false;
    print_result(options.json, json, [&] { return summary_of_simulation(json); });
    return true;
  });
  if (!complete) return ExitCode::cancelled;
  spdlog::info("wrote {}", options.folder.string());
  return ExitCode::ok;
}

}  // namespace

void add_simulate_command(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(
      "simulate",
      "Record a workcell with simulated cameras, as a BOP scene folder with ground truth; or over "
      "time, as one folder for each instant");
  const auto options = std::make_shared<SimulateOptions>();
  verb->add_option("workcell", options->workcell,
                   "Workcell file (YAML) with cameras and the objects in front of them")
      ->required();
  add_output_option(*verb, options->folder, "the dataset")->required();
  add_random_options(*verb, *options);
  add_sequence_options(*verb, *options);
  add_color_options(*verb, *options);
  add_depth_options(*verb, *options);
  add_json_flag(*verb, options->json, "simulation.json");
  add_threads_option(*verb, options->threads);
  verb->footer(
      "Examples:\n"
      "  vantage simulate assets/workcells/castle.yaml -o castle\n"
      "  vantage simulate assets/workcells/clutter.yaml --objects 20 --types red_cube --seed 7 -o "
      "c\n"
      "  vantage simulate assets/workcells/duck.yaml --ideal-depth --samples 64 -o duck\n"
      "  vantage simulate assets/workcells/clutter.yaml --objects 6 --instants 30 --moves 2 -o s");
  set_action(*verb, action, options, simulate);
}

}  // namespace vantage
