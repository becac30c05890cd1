#include "evaluate/reconstruction/evaluation_truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

#include "documents/document_value.hpp"
#include "documents/json_document.hpp"
#include "documents/schema_check.hpp"
#include "metrics/bop/pose_errors.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

constexpr double kSameObject = 0.1;  // of the diameter

const nlohmann::json& scene_gt_schema() {
  static const nlohmann::json schema = nlohmann::json::parse(R"({
    "type": "object",
    "additionalProperties": {"type": "array", "items": {
      "type": "object",
      "required": ["obj_id", "cam_R_m2c", "cam_t_m2c"],
      "properties": {
        "obj_id": {"type": "integer"},
        "cam_R_m2c": {"type": "array", "items": {"type": "number"}, "minItems": 9, "maxItems": 9},
        "cam_t_m2c": {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}
      }}}})");
  return schema;
}

TypePtr type_of(const Value& id, const KnowledgeBase& knowledge) {
  for (const TypePtr& type : knowledge.types()) {
    if (type->bop_id == id.as<int>()) return type;
  }
  throw id.error(
      fmt::format("the knowledge base has no BOP model {}; set the workcell's knowledge_base to "
                  "the folder of the dataset's models",
                  id.as<int>()));
}

Pose model_to_camera(const Value& entry) {
  const Value r = entry["cam_R_m2c"];
  Eigen::Matrix3d rotation;
  for (std::size_t i = 0; i < 9; ++i) {
    rotation(Eigen::Index(i / 3), Eigen::Index(i % 3)) = r.number(i);
  }
  return Pose::from_rotation(rotation, entry["cam_t_m2c"].vector() / 1000, entry.place());
}

/// Collects objects that several images name.
class SceneObjects {
 public:
  void add(const TypePtr& type, const Pose& T_world_object) {
    const auto [entry, is_new] = models_.try_emplace(type->name);
    auto& model = entry->second;
    if (is_new) model = error_model(*type->mesh, type->symmetries);
    const double near_m = kSameObject * model.diameter_m;
    const bool known = std::ranges::any_of(objects_, [&](const TrueObject& object) {
      return object.type == type && mssd_m(model, T_world_object, object.T_world_object) < near_m;
    });
    if (known) return;
    const std::string name = fmt::format("{} {}", type->name, ++counts_[type->name]);
    objects_.push_back({name, type, T_world_object});
  }
  std::vector<TrueObject> take() { return std::move(objects_); }

 private:
  std::vector<TrueObject> objects_;
  std::map<std::string, ErrorModel> models_;
  std::map<std::string, int> counts_;
};

std::vector<TrueObject> from_scene_gt(const fs::path& file, const KnowledgeBase& knowledge,
                                      const BopScene& scene) {
  const Document document = read_document(file);
  check_schema(document, scene_gt_schema());
  const Value images(document);
  SceneObjects objects;
  for (const BopImage& image : scene.images) {
    const std::string id = std::to_string(image.id);
    if (!images.has(id.c_str())) continue;
    for (const Value& entry : images[id.c_str()].elements()) {
      objects.add(type_of(entry["obj_id"], knowledge),
                  image.camera().T_world_cam() * model_to_camera(entry));
    }
  }
  return objects.take();
}

}  // namespace

std::vector<TrueObject> true_objects(const Workcell& workcell, const BopScene& scene,
                                     std::vector<fs::path>& files) {
  std::vector<TrueObject> objects;
  for (const PlacedObject& object : workcell.known_objects) {
    if (object.type) objects.push_back({object.name, object.type, object.T_world_object});
  }
  const fs::path file = scene.folder / "scene_gt.json";
  if (objects.empty() && fs::exists(file)) {
    objects = from_scene_gt(file, *workcell.knowledge, scene);
    files.push_back(file);
  }
  if (!objects.empty()) return objects;
  throw bad_input(scene.folder.string(),
                  "there is no ground truth: the workcell has no known_objects with a type, and "
                  "there is no scene_gt.json with objects; evaluate a simulated dataset with its "
                  "own workcell.yaml, or a dataset with BOP's ground truth");
}

}  // namespace vantage
