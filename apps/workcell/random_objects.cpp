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

/// The floor that objects may stand on, and all the work area above it.
Box floor_of(const Workcell& workcell) {
  Eigen::Vector3d min = workcell.work_area.min(), max = workcell.work_area.max();
  if (workcell.board) {
    const Eigen::Vector2d half = 0.5 * workcell.board->size_m;
    min = {std::max(min.x(), -half.x()), std::max(min.y(), -half.y()), 0};
    max.head<2>() = max.head<2>().cwiseMin(half);
  }
  return Box(min, max, "random_objects: the part of the work area above the board");
}

double top_of(const KnownObject& object) {
  double top = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3f& vertex : object.mesh->vertices()) {
    top = std::max(top, (object.T_world_object * vertex.cast<double>()).z());
  }
  return top;
}

/// What random objects must not touch: all that rises above the floor. The floor's own table would
/// be touched by everything.
std::vector<KnownObject> obstacles_of(const Workcell& workcell, double floor_z) {
  std::vector<KnownObject> obstacles;
  for (const auto* list :
       {&workcell.static_structures, &workcell.known_objects, &workcell.foreign_objects}) {
    for (const KnownObject& object : known(*list)) {
      if (top_of(object) > floor_z + kTouching) obstacles.push_back(object);
    }
  }
  return obstacles;
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
  const Box floor = floor_of(workcell);
  try {
    return place_at_rest(
        meshes, obstacles_of(workcell, floor.min().z()),
        {.area = floor, .seed = random.seed, .upright_share = random.upright_share});
  } catch (const Error& error) {  // knows of no file
    const std::string file = workcell.files.empty() ? "" : workcell.files.front().string() + ": ";
    throw Error(error.code(), file + "random_objects, " + error.where(), error.message());
  }
}

}  // namespace

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
