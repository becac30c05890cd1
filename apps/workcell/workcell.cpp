#include "workcell/workcell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "cli/signal_handler.hpp"
#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "documents/value_readers.hpp"
#include "documents/yaml_document.hpp"
#include "options/field_json.hpp"
#include "options/sensor_fields.hpp"
#include "options/volume_fields.hpp"
#include "workcell/view_list.hpp"
#include "workcell/workcell_views.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

/// A file, or a list of files, that a value names.
std::vector<fs::path> named_files(const Value& value, const fs::path& folder,
                                  std::vector<fs::path>& files) {
  if (value.is_string()) return {named_file(value, folder, files)};
  std::vector<fs::path> named;
  for (const Value& name : value.elements()) named.push_back(named_file(name, folder, files));
  return named;
}

void read_sensor(const Value& value, const fs::path& folder, Workcell& workcell) {
  if (value.has("calibration")) {
    workcell.calibrations = named_files(value["calibration"], folder, workcell.files);
  }
  if (value.has("depth_lens")) {
    const bool is_pinhole = value["depth_lens"].as<std::string>() == "pinhole";
    workcell.depth_lens = is_pinhole ? DepthLens::pinhole : DepthLens::calibrated;
  }
  if (value.has("depth_range_m")) workcell.sensor_range = read_range(value["depth_range_m"]);
  if (value.has("intrinsics")) workcell.sensor_intrinsics = read_intrinsics(value["intrinsics"]);
}

void read_movable_camera(const Value& value, Workcell& workcell) {
  workcell.movable_intrinsics = read_intrinsics(value);
  if (value.has("depth_range_m")) workcell.movable_range = read_range(value["depth_range_m"]);
  if (value.has("depth")) {
    read_fields(value["depth"], fields_of(workcell.plan.sensor));
    workcell.plan.sensor.check(value["depth"].place());
  }
}

std::vector<CellCamera> read_cameras(const Value& value, const Workcell& workcell) {
  std::vector<CellCamera> cameras;
  std::map<std::string, std::string> places;  // name → where it stands
  for (const Value& element : value.elements()) {
    const std::string name = element["name"].as<std::string>();
    const auto [first, is_new] = places.try_emplace(name, element["name"].place());
    if (!is_new) {
      throw element["name"].error(fmt::format(
          "the name \"{}\" is taken by {}; cameras' names have to differ", name, first->second));
    }
    const Intrinsics intrinsics = element.has("intrinsics") ? read_intrinsics(element["intrinsics"])
                                                            : workcell.sensor_intrinsics;
    const Pose pose = element.has("pose") ? read_pose(element["pose"]) : read_looking_at(element);
    cameras.push_back({name, PinholeCamera(intrinsics, pose, workcell.sensor_range)});
  }
  return cameras;
}

/// @param workcell its constraints are those where the file says nothing.
void read_settings(const Value& root, const fs::path& folder, Workcell& workcell) {
  if (root.has("sensor")) read_sensor(root["sensor"], folder, workcell);
  if (root.has("movable_camera")) read_movable_camera(root["movable_camera"], workcell);
  if (root.has("candidates")) {
    workcell.candidates = read_candidates(root["candidates"], folder, workcell.files);
  }
  workcell.constraints = read_constraints(root, folder, workcell.constraints, workcell.files);
  read_fields(root,
              {"", "", {voxel_size_field(workcell.voxel_size_m)}, {fields_of(workcell.volume)}});
  if (root.has("plan")) read_fields(root["plan"], fields_of(workcell.plan));
  if (root.has("cameras")) workcell.cameras = read_cameras(root["cameras"], workcell);
}

std::shared_ptr<const FileKnowledgeBase> read_knowledge(const Value& value,
                                                        const fs::path& folder) {
  std::vector<fs::path> files;
  if (value.is_string()) {
    named_file_or_folder(value, folder, files);
  } else {
    for (const Value& name : value.elements()) named_file_or_folder(name, folder, files);
  }
  return std::make_shared<const FileKnowledgeBase>(files);
}

/// Adds those that are not there yet.
void add_files(const std::vector<fs::path>& more, std::vector<fs::path>& files) {
  for (const fs::path& file : more) {
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  }
}

RandomObjects read_random_objects(const Value& value, const KnowledgeBase& knowledge) {
  RandomObjects random{.count = value["count"].as<int>()};
  for (const Value& name : value["types"].elements()) {
    random.types.push_back(knowledge.get(name.as<std::string>(), name.place()));
  }
  random.seed = value.get("seed", random.seed);
  random.upright_share = value.get("upright_share", random.upright_share);
  return random;
}

/// What stands in the cell.
void read_contents(const Value& root, const fs::path& folder, Workcell& workcell) {
  if (root.has("knowledge_base")) {
    const auto knowledge = read_knowledge(root["knowledge_base"], folder);
    add_files(knowledge->files(), workcell.files);
    workcell.knowledge = knowledge;
  }
  ObjectReader objects(folder, *workcell.knowledge, workcell.files);
  const auto read_all = [&](const char* key, std::vector<PlacedObject>& to) {
    if (!root.has(key)) return;
    for (const Value& value : root[key].elements()) to.push_back(objects.read(value));
  };
  read_all("static_structures", workcell.static_structures);
  read_all("known_objects", workcell.known_objects);
  read_all("foreign_objects", workcell.foreign_objects);
  if (root.has("board")) {
    workcell.board = read_board(root["board"], *workcell.knowledge, folder, workcell.files);
  }
  if (root.has("random_objects")) {
    workcell.random_objects = read_random_objects(root["random_objects"], *workcell.knowledge);
  }
}

}  // namespace

Workcell load_workcell(const fs::path& path, const ViewConstraints& usual) {
  const ReadingPhase reading;
  const Document document = read_yaml(path);
  check_schema(document, workcell_schema());
  const Value root(document);

  Workcell workcell{.work_area = read_box(root["work_area"]), .constraints = usual};
  workcell.files.push_back(path);
  read_settings(root, path.parent_path(), workcell);
  read_contents(root, path.parent_path(), workcell);
  return workcell;
}

}  // namespace vantage
