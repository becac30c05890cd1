#include "evaluate/gain/judged_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cli/sha256.hpp"
#include "cli/signal_handler.hpp"
#include "documents/document_value.hpp"
#include "documents/json_document.hpp"
#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "documents/value_readers.hpp"
#include "options/candidate_fields.hpp"
#include "options/field_json.hpp"
#include "options/sensor_fields.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using PlainJson = nlohmann::json;

bool was_read(const PlainJson& plan, const fs::path& file) {
  if (!fs::exists(file)) return false;
  const std::string hash = sha256_of_file(file);
  return std::ranges::any_of(plan["inputs"],
                             [&](const PlainJson& input) { return input["sha256"] == hash; });
}

/// The dataset that the plan was made from: beside the workcell, or where the plan says.
fs::path dataset_of(const PlainJson& plan, const fs::path& workcell_file,
                    const fs::path& plan_file) {
  constexpr const char* kCameras = "scene_camera.json";
  const fs::path said = plan["config"].value("dataset", "");
  for (const fs::path& folder : {workcell_file.parent_path(), said}) {
    if (was_read(plan, folder / kCameras)) return folder.empty() ? fs::path(".") : folder;
  }
  throw bad_input(
      plan_file.string(),
      fmt::format("it was made from another dataset than the one of {}: none of its "
                  "inputs has the SHA-256 of {}. Give the workcell.yaml of the dataset "
                  "that was planned for, or plan anew",
                  workcell_file.string(), (workcell_file.parent_path() / kCameras).string()));
}

void check_workcell(const PlainJson& plan, const fs::path& workcell_file,
                    const fs::path& plan_file) {
  const PlainJson said = plan["config"].value("workcell", PlainJson());
  if (said.is_null() || was_read(plan, workcell_file)) return;
  throw bad_input(plan_file.string(),
                  fmt::format("it was made with another workcell than {}: none of its inputs has "
                              "that file's SHA-256. Give the workcell that was planned with ({}), "
                              "or plan anew",
                              workcell_file.string(), said.get<std::string>()));
}

PlanOptions options_of(const PlainJson& config, const fs::path& dataset,
                       const fs::path& workcell_file) {
  PlanOptions options{.dataset = dataset, .workcell = workcell_file};
  for (const char* corner : {"min_m", "max_m"}) {
    for (const PlainJson& x : config["work_area"][corner]) options.work_area.push_back(x);
  }
  options.images = config.value("images", std::vector<int>());
  options.objects.objects = config.value("objects", "");
  options.depth_range = config.value("sensor_depth_range_m", std::vector<double>());
  options.given["volume"] = config["volume"];
  return options;
}

/// What the plan says of its request, over what the workcell says.
void restore(const Value& plan, const PlainJson& config, PlanRequest& request) {
  const Value camera = plan["camera"];
  request.intrinsics = read_intrinsics(camera);
  request.range = {camera["near_m"].as<double>(), camera["far_m"].as<double>()};
  request.range.check(camera.place());
  request.voxel_size_m = plan["voxel_size_m"].as<double>();
  if (config["candidates"].contains("radii_m")) {
    HalfSpheres spheres = production_views();
    read_given(config["candidates"], fields_of(spheres));
    request.candidates = spheres;
  }
  if (!config.contains("expected_gain")) return;
  const PlainJson& gain = config["expected_gain"];
  request.gain.unknown_depth = gain["unknown_depth"];
  if (gain["sensor"] == "ideal") {
    request.gain.sensor = StereoSensor::ideal();
  } else {
    read_given(gain, {"", "", {}, {fields_of(request.gain.sensor)}});
  }
}

JudgedView view_of(const Value& view) {
  JudgedView result{read_pose(view["T_world_cam"]), view["newly_observed_volume_m3"].as<double>()};
  if (!view.has("expected_volume_m3")) return result;
  const auto interval = view["expected_interval_m3"].as<std::vector<double>>();
  result.expected = {view["expected_volume_m3"].as<double>(), interval.at(0), interval.at(1)};
  return result;
}

JudgedPlan judged_plan(const Document& document, const fs::path& workcell_file,
                       const fs::path& plan_file, const StopToken& stop) {
  const Value plan(document);
  if (plan["best"].is_null()) throw plan["best"].error("the plan has no best view to be judged");
  const PlainJson& json = document.root;
  check_workcell(json, workcell_file, plan_file);
  const fs::path dataset = dataset_of(json, workcell_file, plan_file);
  JudgedPlan judged{
      load_plan_input(options_of(json["config"], dataset, workcell_file), stop), {}, {}, {}};
  restore(plan, json["config"], judged.input.request);
  for (const Value& view : plan["views"].elements()) judged.views.push_back(view_of(view));
  for (const Value& view : plan["ranked"].elements()) {
    judged.ranked.push_back(read_pose(view["T_world_cam"]));
  }
  for (std::size_t i = 0; i < json["candidates"].size(); ++i) {
    if (json["candidates"][i]["feasible"] == true) judged.feasible.push_back(i);
  }
  if (!json["volumes_m3"].is_null()) judged.shadow_m3 = json["volumes_m3"]["shadow"];
  return judged;
}

}  // namespace

JudgedPlan read_judged_plan(const fs::path& workcell_file, const fs::path& plan_file,
                            const StopToken& stop) {
  const ReadingPhase reading;
  const Document document = read_document(plan_file);
  check_schema(document, plan_schema());
  try {
    return judged_plan(document, workcell_file, plan_file, stop);
  } catch (const PlainJson::exception& error) {  // the schema leaves `config` open
    throw bad_input(document.place("/config"),
                    fmt::format("is not as vantage writes it ({}); expected plan.json as it was "
                                "written, plan anew",
                                error.what()));
  }
}

}  // namespace vantage
