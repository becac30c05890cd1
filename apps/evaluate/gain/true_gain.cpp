#include "evaluate/gain/true_gain.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/volume_text.hpp"
#include "evaluate/expected_gain/measured_gain.hpp"
#include "evaluate/gain/gain_oracle.hpp"
#include "evaluate/gain/judged_plan.hpp"
#include "simulator/scene/ground_truth.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "vantage/volume/advanced/shadow_filter.hpp"
#include "workcell/random_objects.hpp"
#include "workcell/simulated_cell.hpp"

namespace vantage {
namespace {

using Json = nlohmann::ordered_json;

SimulatedCell true_cell(const std::filesystem::path& workcell_file) {
  Workcell workcell = load_workcell(workcell_file);
  place_random_objects(workcell);
  return simulated_cell(workcell);
}

Json view_json(const JudgedView& view, double gain_m3, const std::optional<double>& best_m3) {
  Json json{{"promised_m3", view.promised_m3},
            {"expected_m3", nullptr},
            {"expected_interval_m3", nullptr},
            {"true_gain_m3", gain_m3},
            {"best_true_gain_m3", nullptr}};
  if (view.expected) {
    json["expected_m3"] = view.expected->expected_m3;
    json["expected_interval_m3"] = {view.expected->low_m3, view.expected->high_m3};
  }
  if (best_m3) json["best_true_gain_m3"] = std::max(*best_m3, gain_m3);
  return json;
}

Json share(double part, double whole) {
  return whole > 0 ? Json(part / whole) : Json();
}

/// What an ideal sensor would find hidden, and how much of that the first view really sees.
void add_hidden(const JudgedPlan& plan, const SimulatedScene& scene, const PinholeCamera& view,
                const GridGeometry& geometry, Json& json) {
  std::vector<PinholeCamera> cameras;
  for (const DepthCamera& camera : plan.input.world.cameras) cameras.push_back(camera.camera);
  const GroundTruth truth(scene, cameras, geometry);
  const double hidden_m3 = truth.grid().volume_m3(VoxelState::shadow);
  const double seen_m3 = truth.gain_m3(view);
  json["true_hidden_m3"] = hidden_m3;
  json["true_hidden_seen_m3"] = seen_m3;
  json["gain_of_hidden"] = share(seen_m3, hidden_m3);
}

}  // namespace

Json true_gain(const std::filesystem::path& workcell_file, const std::filesystem::path& plan_file,
               const TrueGainOptions& options, const StopToken& stop) {
  const JudgedPlan plan = read_judged_plan(workcell_file, plan_file, stop);
  const SimulatedCell cell = true_cell(workcell_file);
  const PlanRequest& request = plan.input.request;
  const GridGeometry geometry = GridGeometry::covering(request.work_area, request.voxel_size_m);
  const auto shadow = without_false_shadow(classify(plan.input.world, geometry, request.volume),
                                           plan.input.world, request.volume);
  MeasuredGain truth(cell.scene, plan.input.world, *shadow, request.volume, request.gain.sensor);
  const PinholeCamera camera(request.intrinsics, Pose(), request.range);
  const GainCandidates candidates(plan, *shadow, options.oracle);
  Json views = Json::array();
  for (std::size_t i = 0; i < plan.views.size() && !stop.stop_requested(); ++i) {
    const std::optional<double> best = candidates.best_m3(truth, options.seed + i, stop);
    const double gain = truth.take_m3(camera.moved_to(plan.views[i].T_world_cam), options.seed + i);
    views.push_back(view_json(plan.views[i], gain, best));
  }
  if (views.empty()) return {{"views", views}};
  Json json{{"voxel_size_m", request.voxel_size_m},
            {"shadow_m3", shadow->volume_m3(VoxelState::shadow)},
            {"views", views}};
  const Json& first = views.front();
  for (const char* key : {"promised_m3", "expected_m3", "true_gain_m3", "best_true_gain_m3"}) {
    json[key] = first[key];
  }
  json["gain_of_promised"] = share(first["true_gain_m3"], first["promised_m3"]);
  json["gain_of_expected"] =
      first["expected_m3"].is_null() ? Json() : share(first["true_gain_m3"], first["expected_m3"]);
  const GridGeometry fine = GridGeometry::covering(
      request.work_area, options.voxel_size_m.value_or(request.voxel_size_m));
  add_hidden(plan, cell.scene, camera.moved_to(plan.views.front().T_world_cam), fine, json);
  return json;
}

std::string summary_of_true_gain(const Json& gain) {
  std::string text;
  const auto volume = [](const Json& m3) { return volume_text(m3.get<double>()); };
  for (std::size_t i = 0; i < gain["views"].size(); ++i) {
    const Json& view = gain["views"][i];
    text += fmt::format("view {:<6}promised at most {}", i + 1, volume(view["promised_m3"]));
    if (!view["expected_m3"].is_null()) {
      text += fmt::format(", expected {} ({} to {})", volume(view["expected_m3"]),
                          volume(view["expected_interval_m3"][0]),
                          volume(view["expected_interval_m3"][1]));
    }
    text += fmt::format("\n{:<11}truly gained {}", "", volume(view["true_gain_m3"]));
    if (!view["best_true_gain_m3"].is_null()) {
      const double best = view["best_true_gain_m3"];
      text += fmt::format(", {:.1f} % of the {} of the best view",
                          best > 0 ? 100 * view["true_gain_m3"].get<double>() / best : 100.0,
                          volume_text(best));
    }
    text += "\n";
  }
  const double hidden = gain["true_hidden_m3"], seen = gain["true_hidden_seen_m3"];
  text += fmt::format(
      "shadow     {} before, in voxels of {} m\n"
      "hidden     {} for ideal sensors, of which the first view has {} in sight{}\n",
      volume(gain["shadow_m3"]), gain["voxel_size_m"].get<double>(), volume_text(hidden),
      volume_text(seen), hidden > 0 ? fmt::format(", {:.1f} %", 100 * seen / hidden) : "");
  return text;
}

}  // namespace vantage
