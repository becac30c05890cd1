#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <iostream>
#include <memory>
#include <numbers>

#include "cli/command.hpp"
#include "cli/number_checks.hpp"
#include "cli/progress_line.hpp"
#include "cli/signal_handler.hpp"
#include "cli/workers.hpp"
#include "simulate/simulated_dataset.hpp"
#include "simulate/simulation_record.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

struct SimulateOptions {
  fs::path workcell, folder;
  SimulationOptions settings;
  bool ideal_depth = false, no_second_imager = false, no_projector = false;
  std::optional<double> noise_px, max_incidence_deg;
  std::vector<double> distortion;
  bool json = false;
  int threads = 0;
};

void add_random_options(CLI::App& verb, SimulateOptions& a) {
  SimulationOptions& s = a.settings;
  verb.add_option("--seed", s.seed, "Of the noise and of random objects; another seed, others");
  verb.add_option("--objects", s.objects,
                  "Lay this many objects on the board at random, instead of the workcell's "
                  "random_objects")
      ->check(CLI::Range(0, 10000));
  verb.add_option("--types", s.types, "Their types, taken in turns, e.g. red_cube,duck")
      ->delimiter(',');
}

void add_color_options(CLI::App& verb, SimulateOptions& a) {
  ColorSensor& color = a.settings.recording.color;
  verb.add_option("--samples", color.samples_per_pixel, "Rays through each pixel of a colour image")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  verb.add_option("--distortion", a.distortion,
                  "K1 K2 P1 P2 K3: the colour lens' Brown-Conrady distortion; none without it")
      ->expected(5);
  verb.add_option("--vignetting", color.vignetting, "Darker corners: 0 none, 1 the cos⁴ law")
      ->check(number_between(0.0, 1.0));
  verb.add_option("--read-noise", color.read_noise,
                  "Standard deviation of the linear signal; full scale is 1")
      ->check(number_between(0.0, 1.0));
  verb.add_option("--shot-noise", color.shot_noise, "Variance for each unit of the linear signal")
      ->check(number_between(0.0, 1.0));
}

void add_depth_options(CLI::App& verb, SimulateOptions& a) {
  StereoSensor& depth = a.settings.recording.depth;
  verb.add_option(
      "--depth-noise-px", a.noise_px,
      "Noise of the disparity, pixels; 0: none. Without it, the workcell's volume.noise");
  verb.add_option("--disparity-step-px", depth.disparity_step_px,
                  "Disparities are multiples of this; 0: not quantised")
      ->capture_default_str();
  verb.add_option("--max-disparity-px", depth.max_disparity_px,
                  "Nearer surfaces are not found; 0: no limit")
      ->capture_default_str();
  verb.add_flag("--no-second-imager", a.no_second_imager,
                "No holes where the second imager sees something else");
  verb.add_flag("--no-projector", a.no_projector,
                "No holes in the shadow of the projector's light");
  verb.add_option("--max-incidence-deg", a.max_incidence_deg,
                  "Holes where a surface is more slanted than this; 90: no limit (default: 80)")
      ->check(number_between(1.0, 90.0));
  verb.add_option("--border-px", depth.border_px, "Pixels without depth along the image's edges")
      ->capture_default_str();
  verb.add_option("--flying-pixels", depth.flying_pixels,
                  "Share of the pixels beside a jump in depth that float in between")
      ->check(number_between(0.0, 1.0))
      ->capture_default_str();
}

void add_depth_format_options(CLI::App& verb, SimulateOptions& a) {
  CLI::Option* ideal = verb.add_flag("--ideal-depth", a.ideal_depth,
                                     "Measure every surface exactly: none of the effects above");
  for (const char* effect : {"--depth-noise-px", "--disparity-step-px", "--max-disparity-px",
                             "--max-incidence-deg", "--border-px", "--flying-pixels"}) {
    ideal->excludes(effect);
  }
  verb.add_option("--depth-scale-mm", a.settings.recording.depth_scale_mm,
                  "Millimetres a count of the depth images")
      ->check(number_between(1e-3, 100.0))
      ->capture_default_str();
}

/// The command line's flags on top of the workcell's sensor.
RecordingOptions recording_of(const SimulateOptions& a, const Workcell& workcell) {
  RecordingOptions recording = a.settings.recording;
  StereoSensor& depth = recording.depth;
  depth.noise = workcell.volume.noise;
  if (a.ideal_depth) depth = StereoSensor::ideal();
  if (a.noise_px) depth.noise.subpixel_px = *a.noise_px;
  if (a.no_second_imager) depth.second_imager = false;
  if (a.no_projector) depth.projector = false;
  if (a.max_incidence_deg) {
    depth.max_incidence_rad = *a.max_incidence_deg * std::numbers::pi / 180;
  }
  if (!a.distortion.empty()) {
    const double* d = a.distortion.data();
    recording.color.distortion = {d[0], d[1], d[2], d[3], d[4]};
  }
  return recording;
}

ExitCode simulate(const SimulateOptions& options) {
  const StopToken stop;
  const SignalHandler interrupt({stop});
  Workers workers(options.threads);

  Workcell workcell = load_workcell(options.workcell);
  SimulationOptions settings = options.settings;
  settings.recording = recording_of(options, workcell);
  prepare_objects(workcell, settings);
  check_recording(workcell, settings.recording);
  claim_folder(options.folder);
  const bool complete = workers.execute([&] {
    const ProgressLine progress("recording", stop);
    const SimulatedCell cell = simulated_cell(workcell);
    const auto json =
        write_simulation_record(options.workcell, workcell, cell, settings, options.folder);
    if (!record(workcell, cell, settings.recording, options.folder, stop)) return false;
    std::cout << (options.json ? json.dump(1) + "\n" : summary_of_simulation(json)) << std::flush;
    return true;
  });
  if (!complete) return ExitCode::cancelled;
  spdlog::info("wrote {}", options.folder.string());
  return ExitCode::ok;
}

}  // namespace

void add_simulate_command(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(
      "simulate", "Record a workcell with simulated cameras, as a BOP scene folder with its truth");
  const auto options = std::make_shared<SimulateOptions>();
  verb->add_option("workcell", options->workcell,
                   "Workcell file (YAML) with cameras and what stands before them")
      ->required();
  verb->add_option("-o,--output", options->folder, "The dataset's folder; it is made")->required();
  add_random_options(*verb, *options);
  add_color_options(*verb, *options);
  add_depth_options(*verb, *options);
  add_depth_format_options(*verb, *options);
  verb->add_flag("--json", options->json, "Print simulation.json on stdout instead of a summary");
  verb->add_option("--threads", options->threads, "Threads to use (0: all)")
      ->check(CLI::Range(0, 1024));
  verb->parse_complete_callback(
      [&action, options] { action = [=] { return simulate(*options); }; });
}

}  // namespace vantage
