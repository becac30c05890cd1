#include "reconstruct/scene_warnings.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

namespace vantage {
namespace {

constexpr double kLargest_m = 10;  ///< of what stands in a workcell

std::string size_warning(const std::string& what, double size_m) {
  return fmt::format("{} is {:.4g} m large: is that in millimetres? Metres are expected", what,
                     size_m);
}

}  // namespace

std::vector<std::string> camera_warnings(const BopScene& scene, const ObservedScene& observed) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    const CameraLocation& location = observed.locations[i];
    if (!observed.views[i].T_world_cam) {
      warnings.push_back(fmt::format("skipping image {}: {}", scene.images[i].id, location.reason));
    }
    if (!location.warning.empty()) {
      warnings.push_back(fmt::format("image {}: {}", scene.images[i].id, location.warning));
    }
  }
  return warnings;
}

std::vector<std::string> object_warnings(const Reconstruction& result,
                                         const std::vector<KnownObject>& objects) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::string& warning = result.objects[i].warning;
    if (!warning.empty()) warnings.push_back(objects[i].name + ": " + warning);
  }
  return warnings;
}

std::vector<std::string> type_warnings(const Workcell& workcell) {
  std::vector<std::string> warnings;
  if (workcell.board && workcell.board->size_m.maxCoeff() > kLargest_m) {
    warnings.push_back(size_warning("the board", workcell.board->size_m.maxCoeff()));
  }
  for (const TypePtr& type : workcell.knowledge->types()) {
    for (const std::string& remark : type->mesh->remarks()) {
      warnings.push_back(fmt::format("type {}: {}", type->name, remark));
    }
    Eigen::AlignedBox3f bounds;
    for (const Eigen::Vector3f& vertex : type->mesh->vertices()) bounds.extend(vertex);
    if (bounds.isEmpty()) continue;
    const double size_m = double(bounds.sizes().maxCoeff());
    if (size_m > kLargest_m) warnings.push_back(size_warning("type " + type->name, size_m));
  }
  return warnings;
}

}  // namespace vantage
