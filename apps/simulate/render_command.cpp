#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/command.hpp"
#include "cli/interruptible_run.hpp"
#include "cli/picture_file.hpp"
#include "cli/shared_options.hpp"
#include "simulator/color/color_sensor.hpp"
#include "simulator/scene/resized_camera.hpp"
#include "simulator/sheet/contact_sheet.hpp"
#include "workcell/simulated_cell.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  std::vector<fs::path> workcells;
  fs::path picture;
  std::string camera;
  bool contact_sheet = false;
  int samples = 64;
  int threads = 0;
};

/// A workcell with everything that stands in it, and its name.
struct Subject {
  std::string name;
  Workcell workcell;
};

Subject load_subject(const fs::path& file) {
  Subject subject{file.stem().string(), load_workcell(file)};
  place_random_objects(subject.workcell);
  if (subject.workcell.cameras.empty()) {
    throw bad_input(file.string() + ": cameras", "there are no cameras to render");
  }
  return subject;
}

const CellCamera& chosen_camera(const Subject& subject, const std::string& name) {
  const std::vector<CellCamera>& cameras = subject.workcell.cameras;
  if (name.empty()) return cameras.front();
  const auto found = std::find_if(cameras.begin(), cameras.end(),
                                  [&](const CellCamera& camera) { return camera.name == name; });
  if (found != cameras.end()) return *found;
  std::string names;
  for (const CellCamera& camera : cameras) names += (names.empty() ? "" : ", ") + camera.name;
  throw bad_input("--camera", fmt::format("found {}; the workcell's cameras are {}", name, names));
}

std::optional<ColorImage> photograph(const SimulatedCell& cell, const CellCamera& camera,
                                     const RenderOptions& options, const StopToken& stop) {
  return simulate_color(cell.scene, {}, camera.camera, {.samples_per_pixel = options.samples}, 0,
                        stop);
}

/// The camera with as few pixels as its thumbnail on the sheet has: samples of more would only be
/// averaged.
CellCamera as_thumbnail(CellCamera camera) {
  const int room = ContactSheetOptions().cell_width;
  const Intrinsics& k = camera.camera.intrinsics();
  const double scale = std::min(double(room) / k.width, 0.75 * room / k.height);
  if (scale >= 1) return camera;
  const auto scaled = [&](int pixels) { return std::max(1, int(std::lround(scale * pixels))); };
  camera.camera = resized_camera(camera.camera, scaled(k.width), scaled(k.height));
  return camera;
}

std::optional<ColorImage> sheet(const RenderOptions& options, const StopToken& stop) {
  std::vector<Subject> subjects;
  std::uint64_t total = 0;
  for (const fs::path& file : options.workcells) {
    subjects.push_back(load_subject(file));
    total += subjects.back().workcell.cameras.size();
  }
  stop.expect(total);
  std::vector<LabelledPicture> pictures;
  for (const Subject& subject : subjects) {
    const SimulatedCell cell = simulated_cell(subject.workcell);
    for (const CellCamera& camera : subject.workcell.cameras) {
      auto image = photograph(cell, as_thumbnail(camera), options, stop);
      if (!image) return std::nullopt;
      pictures.push_back({subject.name, camera.name, std::move(*image)});
      stop.advance(1);
    }
  }
  return contact_sheet(pictures);
}

std::optional<ColorImage> single(const RenderOptions& options, const StopToken& stop) {
  if (options.workcells.size() > 1) {
    throw bad_input("vantage render", fmt::format("found {} workcells; expected one, or "
                                                  "--contact-sheet for all of them in one picture",
                                                  options.workcells.size()));
  }
  const Subject subject = load_subject(options.workcells.front());
  return photograph(simulated_cell(subject.workcell), chosen_camera(subject, options.camera),
                    options, stop);
}

ExitCode render(const RenderOptions& options) {
  InterruptibleRun run(options.threads);
  const std::optional<ColorImage> image = run.execute("rendering", [&] {
    return options.contact_sheet ? sheet(options, run.stop()) : single(options, run.stop());
  });
  if (!image) return ExitCode::cancelled;
  write_picture(options.picture, *image);
  spdlog::info("wrote {}", options.picture.string());
  return ExitCode::ok;
}

}  // namespace

void add_render_command(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("render", "Render workcells: one camera's view, or a contact sheet");
  const auto options = std::make_shared<RenderOptions>();
  verb->add_option("workcells", options->workcells, "Workcell files (YAML) with cameras")
      ->required();
  verb->add_option("-o,--output", options->picture, "Picture to write: .png or .jpg")->required();
  verb->add_option("--camera", options->camera, "Camera to render (default: the first)");
  verb->add_flag("--contact-sheet", options->contact_sheet,
                 "All cameras of all workcells in one picture")
      ->excludes("--camera");
  verb->add_option("--samples", options->samples,
                   "Rays per pixel; with --contact-sheet, per pixel of the thumbnails")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  add_threads_option(*verb, options->threads);
  verb->footer(
      "Examples:\n"
      "  vantage render assets/workcells/castle.yaml -o castle.png\n"
      "  vantage render assets/workcells/corridor.yaml --camera left --samples 16 -o left.jpg\n"
      "  vantage render assets/workcells/wall.yaml assets/workcells/duck.yaml --contact-sheet -o "
      "s.jpg");
  set_action(*verb, action, options, render);
}

}  // namespace vantage
