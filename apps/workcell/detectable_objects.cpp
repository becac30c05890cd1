#include "workcell/detectable_objects.hpp"

#include <algorithm>

namespace vantage {
namespace {

// A line of sight ends this far before the point: the surface under it must not hide it.
constexpr double kBeforePoint_m = 1e-3;

bool sees(const PinholeCamera& camera, const Eigen::Vector3d& point, const Scene& truth) {
  if (!camera.in_view(point.cast<float>())) return false;
  const Eigen::Vector3d to_camera = (camera.centre() - point).normalized();
  const Eigen::Vector3d before = point + kBeforePoint_m * to_camera;
  return !truth.occluded(before.cast<float>(), camera.centre().cast<float>());
}

bool recognises(const PinholeCamera& camera, const PlacedObject& object, const Scene& truth) {
  return std::ranges::any_of(object.type->features, [&](const ObjectFeature& feature) {
    const std::vector<Eigen::Vector3d> points = feature.points();
    return !points.empty() && std::ranges::all_of(points, [&](const Eigen::Vector3d& point) {
      return sees(camera, object.T_world_object * point, truth);
    });
  });
}

}  // namespace

std::vector<PlacedObject> recognisable_objects(std::span<const PlacedObject> objects,
                                               std::span<const PinholeCamera> cameras,
                                               const Scene& truth) {
  std::vector<PlacedObject> found;
  std::ranges::copy_if(objects, std::back_inserter(found), [&](const PlacedObject& object) {
    return object.type == nullptr || std::ranges::any_of(cameras, [&](const PinholeCamera& camera) {
             return recognises(camera, object, truth);
           });
  });
  return found;
}

}  // namespace vantage
