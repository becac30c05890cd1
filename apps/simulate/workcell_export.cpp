#include "simulate/workcell_export.hpp"
#include "process/output_folder.hpp"
#include "process/result_output.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "documents/yaml_document.hpp"
#include "vantage/raycore/detail/file.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using SortedJson = nlohmann::json;

constexpr const char* kCopies = "cell";

std::string yaml_text(const SortedJson& root) {
  return "# Written by vantage simulate: the recorded cell.\n" + json_text(root);
}

/// Copies files into one folder, each once, and knows what they are called there.
class Copies {
 public:
  explicit Copies(fs::path folder) : folder_(std::move(folder)) {}

  /// @returns the copy's name.
  std::string copy(const fs::path& file) {
    const auto [entry, is_new] = names_.try_emplace(fs::weakly_canonical(file).string());
    if (is_new) {
      entry->second = free_name(file.filename().string());
      copy_bytes(file, entry->second);
    }
    return entry->second;
  }

  /// The same for a knowledge base: a file with the meshes that it names beside it, or a folder of
  /// BOP models.
  std::string copy_knowledge(const fs::path& path) {
    const fs::path from = fs::weakly_canonical(path);
    const auto [entry, is_new] = names_.try_emplace(from.string());
    if (is_new) {
      entry->second = free_name(from.filename().string());
      if (fs::is_directory(from)) {
        copy_models(from, entry->second);
      } else {
        copy_types(path, entry->second);
      }
    }
    return entry->second;
  }

  /// Copies the mesh file of a type or an object, if it has one, and makes it name the copy.
  void copy_mesh_of(SortedJson& object, const fs::path& folder, const std::string& prefix) {
    const auto replace = [&](SortedJson& path) {
      path = prefix + copy(folder / path.get<std::string>());
    };
    if (object.contains("mesh")) replace(object["mesh"]);
    if (object.contains("shape") && object["shape"].contains("mesh")) {
      replace(object["shape"]["mesh"]["file"]);
    }
  }

 private:
  void copy_types(const fs::path& file, const std::string& name) {
    SortedJson root = read_yaml(file).root;
    for (SortedJson& type : root["object_types"]) copy_mesh_of(type, file.parent_path(), "");
    write(name, yaml_text(root));
  }

  void copy_models(const fs::path& folder, const std::string& name) {
    make_output_folder(folder_ / name);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      const fs::path file = entry.path().filename();
      if (file != "models_info.json" && file.extension() != ".ply") continue;
      copy_bytes(entry.path(), (name / file).string());
    }
  }

  void copy_bytes(const fs::path& file, const std::string& name) {
    const auto bytes = read_file(file);
    write(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }

  /// Files of one name in different folders get numbers.
  std::string free_name(const std::string& wanted) {
    std::string name = wanted;
    for (int i = 2; !taken_.insert(name).second; ++i) name = fmt::format("{}_{}", i, wanted);
    return name;
  }
  void write(const std::string& name, std::string_view bytes) {
    make_output_folder(folder_);
    write_file(folder_ / name, bytes);
  }

  fs::path folder_;
  std::map<std::string, std::string> names_;  // file → the copy's name
  std::set<std::string> taken_;
};

SortedJson object_json(const PlacedObject& object) {
  const Eigen::Quaterniond q = object.T_world_object.quaternion();
  const Eigen::Vector3d& t = object.T_world_object.translation();
  const SortedJson rotation{{"w", q.w()}, {"x", q.x()}, {"y", q.y()}, {"z", q.z()}};
  const SortedJson pose{{"translation_m", SortedJson::array({t.x(), t.y(), t.z()})},
                        {"rotation", rotation}};
  return {{"name", object.name}, {"type", object.type->name}, {"pose", pose}};
}

/// Objects that were placed stand behind those of the file.
void write_out_random_objects(const Workcell& workcell, SortedJson& root) {
  root.erase("random_objects");
  const std::size_t in_file = root.contains("known_objects") ? root["known_objects"].size() : 0;
  for (std::size_t i = in_file; i < workcell.known_objects.size(); ++i) {
    root["known_objects"].push_back(object_json(workcell.known_objects[i]));
  }
}

}  // namespace

void write_cell_bundle(const fs::path& file, const Workcell& workcell,
                       const std::vector<std::string>& calibrations, const fs::path& folder) {
  SortedJson root = read_yaml(file).root;
  write_out_random_objects(workcell, root);
  if (root.contains("sensor")) root["sensor"].erase("calibration");  // of another recording
  if (!calibrations.empty()) {
    root["sensor"]["calibration"] = calibrations;
    root["sensor"]["depth_lens"] = "pinhole";  // as depth is simulated
  }
  const fs::path from = file.parent_path();
  const std::string prefix = std::string(kCopies) + "/";
  Copies copies(folder / kCopies);
  if (root.contains("knowledge_base")) {
    SortedJson names = SortedJson::array();
    const SortedJson& bases = root["knowledge_base"];
    for (const SortedJson& base : bases.is_array() ? bases : SortedJson::array({bases})) {
      names.push_back(prefix + copies.copy_knowledge(from / base.get<std::string>()));
    }
    root["knowledge_base"] = names;
  }
  if (root.contains("board") && root["board"].is_string()) {
    root["board"] = prefix + copies.copy(from / root["board"].get<std::string>());
  }
  for (const char* list : {"static_structures", "known_objects", "foreign_objects"}) {
    if (!root.contains(list)) continue;
    for (SortedJson& object : root[list]) copies.copy_mesh_of(object, from, prefix);
  }
  write_file(folder / "workcell.yaml", yaml_text(root));
}

}  // namespace vantage
