#include "workcell/random_objects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "simulator/placement/placement.hpp"
#include "workcell/workcell.hpp"

namespace vantage {
namespace {

constexpr double kTouching = 1e-6;  // metres; meshes are in float

double top_of(const KnownObject& object) {
  double top = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3f& vertex : object.mesh->vertices()) {
    top = std::max(top, (object.T_world_object * vertex.cast<double>()).z());
  }
  return top;
}

/// What random objects must not touch.
std::vector<KnownObject> obstacles_of(const Workcell& workcell, double floor_z) {
  std::vector<KnownObject> objects;
  for (const auto* list :
       {&workcell.static_structures, &workcell.known_objects, &workcell.foreign_objects}) {
    for (const KnownObject& object : known(*list)) objects.push_back(object);
  }
  return rising_above(objects, floor_z);
}

/// "<type> 1", "<type> 2", …, without the names that are taken.
class Names {
 public:
  explicit Names(const Workcell& workcell) {
    for (const auto* list :
         {&workcell.static_structures, &workcell.known_objects, &workcell.foreign_objects}) {
      for (const PlacedObject& object : *list) taken_.insert(object.name);
    }
  }
  std::string next(const std::string& type) {
    std::string name;
    do {
      name = fmt::format("{} {}", type, ++counts_[type]);
    } while (!taken_.insert(name).second);
    return name;
  }

 private:
  std::set<std::string> taken_;
  std::map<std::string, int> counts_;
};

std::vector<Pose> poses_of(const std::vector<std::shared_ptr<const TriangleMesh>>& meshes,
                           const Workcell& workcell) {
  const RandomObjects& random = *workcell.random_objects;
  const Box floor = random_object_floor(workcell);
  try {
    return place_at_rest(
        meshes, obstacles_of(workcell, floor.min().z()),
        {.area = floor, .seed = random.seed, .upright_share = random.upright_share});
  } catch (const Error& error) {  // knows of no file
    const std::string file = workcell.files.empty() ? "" : workcell.files.front().string() + ": ";
    throw Error(error.code(), file + "random_objects, " + error.where(), error.message());
  }
}

/// Types by their own names and by those above them, each once.
std::vector<TypePtr> types_named(const std::vector<std::string>& names,
                                 const KnowledgeBase& knowledge) {
  std::vector<TypePtr> all;
  for (const std::string& name : names) {
    const auto types = knowledge.types_that_are(name);
    if (types.empty()) knowledge.get(name, "--types");  // says which names there are
    for (const TypePtr& type : types) {
      if (std::ranges::find(all, type) == all.end()) all.push_back(type);
    }
  }
  return all;
}

}  // namespace

Box random_object_floor(const Workcell& workcell) {
  Eigen::Vector3d min = workcell.work_area.min(), max = workcell.work_area.max();
  if (workcell.board) {
    const Eigen::Vector2d half = 0.5 * workcell.board->size_m;
    min = {std::max(min.x(), -half.x()), std::max(min.y(), -half.y()), 0};
    max.head<2>() = max.head<2>().cwiseMin(half);
  }
  return Box(min, max, "random_objects: the part of the work area above the board");
}

std::vector<KnownObject> rising_above(std::span<const KnownObject> objects, double floor_z) {
  std::vector<KnownObject> rising;
  for (const KnownObject& object : objects) {
    if (top_of(object) > floor_z + kTouching) rising.push_back(object);
  }
  return rising;
}

void choose_random_objects(Workcell& workcell, std::optional<int> count,
                           const std::vector<std::string>& types) {
  if (!count && types.empty()) return;
  RandomObjects random = workcell.random_objects.value_or(RandomObjects{});
  if (count) random.count = *count;
  if (!types.empty()) {
    random.types = types_named(types, *workcell.knowledge);
  } else if (random.types.empty()) {
    random.types = workcell.knowledge->types();
  }
  if (random.types.empty() && random.count > 0) {
    throw bad_input("--objects", "the workcell has no knowledge_base, so there are no types");
  }
  workcell.random_objects = random;
}

void place_random_objects(Workcell& workcell) {
  if (!workcell.random_objects || workcell.random_objects->count == 0) return;
  const RandomObjects& random = *workcell.random_objects;
  if (random.types.empty()) throw bad_input("random_objects", "no types; expected one or more");
  Names names(workcell);
  std::vector<PlacedObject> objects;
  std::vector<std::shared_ptr<const TriangleMesh>> meshes;
  for (std::size_t i = 0; i < std::size_t(random.count); ++i) {
    const auto& type = random.types[i % random.types.size()];
    objects.push_back({names.next(type->name), type->mesh, {}, type, type->color});
    meshes.push_back(type->mesh);
  }
  const std::vector<Pose> poses = poses_of(meshes, workcell);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    objects[i].T_world_object = poses[i];
    workcell.known_objects.push_back(std::move(objects[i]));
  }
}

}  // namespace vantage
