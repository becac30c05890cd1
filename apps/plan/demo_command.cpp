#include "plan/demo_command.hpp"

#include <memory>

#include "cli/command.hpp"
#include "cli/signal_handler.hpp"
#include "options/command_line.hpp"
#include "options/field_json.hpp"
#include "options/volume_fields.hpp"
#include "plan/report/plan_json.hpp"
#include "plan/run_options.hpp"

namespace vantage {
namespace {

constexpr double kCube = 0.05;

// An Intel RealSense D435's colour stream at 640 × 480, rounded.
constexpr Intrinsics kCamera{640, 480, 615, 615, 319.5, 239.5};
constexpr DepthRange kRange{0.1, 3.0};

}  // namespace

WorldModel demo_world() {
  WorldModel world;
  const auto cube = std::make_shared<const TriangleMesh>(TriangleMesh::from_box(
      Box(Eigen::Vector3d::Constant(-kCube / 2), Eigen::Vector3d::Constant(kCube / 2))));
  const auto add_cube = [&](double x, double y, int row) {
    world.objects.push_back({"cube " + std::to_string(world.objects.size()), cube,
                             Pose::from_translation({x, y, kCube * (row + 0.5)})});
  };
  // Five, four and three cubes on each other, each row 2 cm further back, and a low second wall
  // behind: no single view reveals all that lies under the overhang and between the two.
  for (int row = 0; row < 3; ++row) {
    for (int i = 0; i < 5 - row; ++i) {
      add_cube(kCube * (i - 0.5 * (4 - row)), 0.02 * row, row);
    }
  }
  for (int i = 0; i < 3; ++i) add_cube(kCube * (i - 1.5), 0.1, 0);
  world.cameras.push_back(
      {"side", PinholeCamera(kCamera, Pose::looking_at({0.1, -0.65, 0.26}, {0, 0, 0.07}), kRange),
       nullptr});
  return world;
}

PlanRequest demo_request() {
  return {.work_area = Box({-0.25, -0.175, 0}, {0.25, 0.175, 0.2}),
          .intrinsics = kCamera,
          .range = kRange};
}

namespace {

struct DemoOptions {
  CommonOptions common;
  double voxel_size_m = demo_request().voxel_size_m;
  nlohmann::json given = nlohmann::json::object();
};

ExitCode demo(const DemoOptions& options) {
  const auto start = StopToken::Clock::now();
  const RunOptions run = options.common.run(start);
  const SignalHandler interrupt(run.tokens());
  PlanRequest request = demo_request();
  read_given(options.given, {"", "", {voxel_size_field(request.voxel_size_m)}});
  PlanRecord record;
  record.config = {{"scene", "demo: a wall of cubes"}};
  OutputOptions output = options.common.output;
  output.pictures = true;
  return run_plan(demo_world(), request, record, output, run, start);
}

}  // namespace

void add_demo_command(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("demo", "Plan the next view of a bundled wall of cubes, with pictures");
  const auto options = std::make_shared<DemoOptions>();
  options->common.output.folder = "out/demo";
  options->common.add_to(*verb);
  verb->get_option("--output")->capture_default_str();
  add_fields(*verb, {"", "Work area", {voxel_size_field(options->voxel_size_m)}}, options->given);
  set_action(*verb, action, options, demo);
}

}  // namespace vantage
