#include "resolved_workcell.hpp"

#include <nlohmann/json.hpp>

#include "yaml_document.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Makes paths that are relative to one folder relative to another.
class PathMover {
 public:
  PathMover(const fs::path& from, const fs::path& to)
      : from_(fs::absolute(from)), to_(fs::weakly_canonical(fs::absolute(to))) {}

  void move(json& path) const {
    const fs::path file = fs::weakly_canonical(from_ / path.get<std::string>());
    path = file.lexically_proximate(to_).generic_string();
  }
  void move_at(json& object, const char* key) const {
    if (object.contains(key)) move(object[key]);
  }

 private:
  fs::path from_, to_;
};

json object_json(const PlacedObject& object) {
  const Eigen::Quaterniond q = object.T_world_object.quaternion();
  const Eigen::Vector3d& t = object.T_world_object.translation();
  return {{"name", object.name},
          {"type", object.type->name},
          {"pose",
           {{"translation_m", {t.x(), t.y(), t.z()}},
            {"rotation", {{"w", q.w()}, {"x", q.x()}, {"y", q.y()}, {"z", q.z()}}}}}};
}

/// Objects that were placed stand behind those of the file.
void write_out_random_objects(const Workcell& workcell, json& root) {
  root.erase("random_objects");
  const std::size_t in_file = root.contains("known_objects") ? root["known_objects"].size() : 0;
  for (std::size_t i = in_file; i < workcell.known_objects.size(); ++i) {
    root["known_objects"].push_back(object_json(workcell.known_objects[i]));
  }
}

}  // namespace

std::string resolved_workcell(const fs::path& file, const Workcell& workcell,
                              const fs::path& folder) {
  json root = read_yaml(file).root;
  write_out_random_objects(workcell, root);
  const PathMover paths(file.parent_path().empty() ? "." : file.parent_path(), folder);
  if (root.contains("knowledge_base")) {
    json& bases = root["knowledge_base"];
    if (bases.is_string()) {
      paths.move(bases);
    } else {
      for (json& base : bases) paths.move(base);
    }
  }
  if (root.contains("board") && root["board"].is_string()) paths.move(root["board"]);
  for (const char* list : {"static_structures", "known_objects", "foreign_objects"}) {
    if (!root.contains(list)) continue;
    for (json& object : root[list]) paths.move_at(object, "mesh");
  }
  return "# Written by vantage simulate: the recorded cell.\n" + root.dump(1) + "\n";
}

}  // namespace vantage
