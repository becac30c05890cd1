#include <fmt/format.h>

#include <map>
#include <set>

#include "vantage/reconstruction/reconstruct.hpp"

namespace vantage {

std::vector<KnownObject> known_objects(const Reconstruction& result,
                                       const std::vector<std::string>& taken) {
  std::map<std::string, int> of_type;
  for (const ReconstructedObject& object : result.objects) ++of_type[object.type->name];
  std::set<std::string> names(taken.begin(), taken.end());
  std::vector<KnownObject> objects;
  for (const ReconstructedObject& object : result.objects) {
    const std::string& type = object.type->name;
    std::string name = type;
    for (int i = 1; names.contains(name) || (name == type && of_type[type] > 1); ++i) {
      name = fmt::format("{} {}", type, i);
    }
    names.insert(name);
    KnownObject known{name, object.type->mesh, object.T_world_object,
                      type, object.covariance, object.probability,
                      {}};
    for (const Alternative& other : object.alternatives) {
      known.alternatives.push_back(
          {other.type->name, other.type->mesh, other.T_world_object, other.probability});
    }
    objects.push_back(std::move(known));
  }
  return objects;
}

}  // namespace vantage
