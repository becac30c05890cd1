#pragma once

#include <memory>
#include <string>

#include "metrics/bop/true_object.hpp"
#include "metrics/turns.hpp"
#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/observation.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

namespace vantage::test {

/// A cube of 5 cm with one feature on top: four points with the key {"mark", name}.
inline TypePtr cube_type(const std::string& name, Symmetries symmetries = {}) {
  ObjectType type{name};
  type.mesh = std::make_shared<const TriangleMesh>(box_solid({0.05, 0.05, 0.05}));
  type.symmetries = std::move(symmetries);
  const FeaturePoints top{
      {{-0.02, 0.02, 0.025}, {0.02, 0.02, 0.025}, {0.02, -0.02, 0.025}, {-0.02, -0.02, 0.025}}};
  type.features = {{{"mark", name}, top}};
  return std::make_shared<const ObjectType>(std::move(type));
}

/// A camera above that sees the marks of these objects where they are.
inline CameraView view_of_marks(const Eigen::Vector3d& eye, const std::vector<TrueObject>& seen) {
  const Lens lens({640, 480, 600, 600, 320, 240}, {});
  CameraView view{"camera", lens, Pose::looking_at(eye, {0, 0, 0})};
  for (const TrueObject& object : seen) {
    SeenPoints points;
    for (const Eigen::Vector3d& point : object.type->features[0].points()) {
      points.pixels.push_back(
          lens.project(view.T_world_cam->inverse() * (object.T_world_object * point)));
    }
    view.observations.push_back({object.type->features[0].key, points});
  }
  return view;
}

inline ReconstructedObject estimate(const TypePtr& type, const Pose& pose, double probability = 1) {
  return {.type = type, .T_world_object = pose, .probability = probability};
}

}  // namespace vantage::test
