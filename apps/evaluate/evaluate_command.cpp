#include "evaluate/evaluate_command.hpp"

#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <vector>

#include "cli/command.hpp"
#include "cli/number_checks.hpp"
#include "cli/shared_options.hpp"
#include "cli/volume_text.hpp"
#include "documents/document_value.hpp"
#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "documents/value_readers.hpp"
#include "documents/yaml_document.hpp"
#include "simulator/scene/ground_truth.hpp"
#include "workcell/simulated_cell.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

/// The camera that a plan suggests.
PinholeCamera suggested_view(const Value& plan) {
  const Value camera = plan["camera"];
  const DepthRange range{camera["near_m"].as<double>(), camera["far_m"].as<double>()};
  range.check(camera.place());
  return PinholeCamera(read_intrinsics(camera), read_pose(plan["best"]["T_world_cam"]), range,
                       camera.place());
}

double share_or_zero(double part, double whole) {
  return whole > 0 ? part / whole : 0;
}

}  // namespace

Json true_gain(const std::filesystem::path& workcell_file, const std::filesystem::path& plan_file,
               std::optional<double> voxel_size_m) {
  const Document document = read_yaml(plan_file);  // JSON is YAML, too
  check_schema(document, plan_schema());
  const Value plan(document);
  if (plan["best"].is_null()) throw plan["best"].error("the plan has no best view to be judged");

  Workcell workcell = load_workcell(workcell_file);
  place_random_objects(workcell);
  const SimulatedCell cell = simulated_cell(workcell);
  std::vector<PinholeCamera> cameras;
  for (const CellCamera& camera : workcell.cameras) cameras.push_back(camera.camera);
  const double size_m = voxel_size_m.value_or(plan["voxel_size_m"].as<double>());
  const GroundTruth truth(cell.scene, cameras, GridGeometry::covering(workcell.work_area, size_m));
  const double promised = plan["best"]["newly_observed_volume_m3"].as<double>();
  const double gain = truth.gain_m3(suggested_view(plan));
  const double hidden = truth.grid().volume_m3(VoxelState::shadow);
  return {{"voxel_size_m", size_m},
          {"promised_m3", promised},
          {"true_gain_m3", gain},
          {"true_hidden_m3", hidden},
          {"gain_of_promised", share_or_zero(gain, promised)},
          {"gain_of_hidden", share_or_zero(gain, hidden)}};
}

std::string summary_of_true_gain(const Json& gain) {
  const auto number = [&](const char* key) { return gain[key].get<double>(); };
  return fmt::format(
      "promised   {} newly observed\n"
      "true gain  {} of the hidden volume really seen: {:.1f} % of the promise\n"
      "hidden     {} before; the view reveals {:.1f} % of it (voxels of {} m)\n",
      volume_text(number("promised_m3")), volume_text(number("true_gain_m3")),
      100 * number("gain_of_promised"), volume_text(number("true_hidden_m3")),
      100 * number("gain_of_hidden"), number("voxel_size_m"));
}

namespace {

struct GainOptions {
  std::filesystem::path workcell, plan;
  std::optional<double> voxel_size_m;
  bool json = false;
};

ExitCode evaluate_gain(const GainOptions& options) {
  const auto gain = true_gain(options.workcell, options.plan, options.voxel_size_m);
  std::cout << (options.json ? gain.dump(1) + "\n" : summary_of_true_gain(gain)) << std::flush;
  return ExitCode::ok;
}

void add_gain(CLI::App& evaluate, Action& action) {
  CLI::App* verb = evaluate.add_subcommand(
      "gain", "What a plan's best view really reveals of a simulated cell, beside its promise");
  const auto options = std::make_shared<GainOptions>();
  verb->add_option("workcell", options->workcell,
                   "The simulated dataset's workcell.yaml: what truly stands there")
      ->required();
  verb->add_option("plan", options->plan, "plan.json")->required();
  verb->add_option("--voxel-size", options->voxel_size_m,
                   "Edge of a voxel of the truth, metres; the plan's without it")
      ->check(positive_number());
  add_json_flag(*verb, options->json, "JSON");
  verb->parse_complete_callback(
      [&action, options] { action = [=] { return evaluate_gain(*options); }; });
}

}  // namespace

void add_evaluate_command(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("evaluate", "Hold results against the truth");
  verb->require_subcommand(1);
  add_gain(*verb, action);
  add_evaluate_planning(*verb, action);
  add_evaluate_reconstruction(*verb, action);
  add_evaluate_shadow_filters(*verb, action);
  add_evaluate_replay(*verb, action);
}

}  // namespace vantage
