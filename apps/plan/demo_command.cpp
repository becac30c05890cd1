#include <memory>

#include "cli/command.hpp"
#include "cli/signal_handler.hpp"
#include "plan/demo_scene.hpp"
#include "plan/plan_json.hpp"
#include "plan/run_options.hpp"

namespace vantage {
namespace {

struct DemoArguments {
  CommonOptions common;
  double voxel_size_m = demo_request().voxel_size_m;
};

ExitCode demo(const DemoArguments& arguments) {
  const auto start = StopToken::Clock::now();
  const RunOptions run = arguments.common.run(start);
  const Interrupt interrupt({run.stop, run.drawing});
  PlanRequest request = demo_request();
  request.voxel_size_m = arguments.voxel_size_m;
  PlanRecord record;
  record.config = {{"scene", "demo: a wall of cubes"}};
  OutputOptions output = arguments.common.output;
  output.pictures = true;
  return run_plan(demo_world(), request, record, output, run, start);
}

}  // namespace

void add_demo_command(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("demo", "Plan the next view of a bundled wall of cubes, with pictures");
  const auto arguments = std::make_shared<DemoArguments>();
  arguments->common.output.folder = "out/demo";
  arguments->common.add_to(*verb);
  verb->get_option("--output")->capture_default_str();
  verb->add_option("--voxel-size", arguments->voxel_size_m, "Edge of a voxel, metres")
      ->capture_default_str();
  verb->parse_complete_callback(
      [&action, arguments] { action = [=] { return demo(*arguments); }; });
}

}  // namespace vantage
