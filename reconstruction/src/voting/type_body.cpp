#include "voting/type_body.hpp"

#include <limits>

#include "vantage/raycore/advanced/scene_builder.hpp"

namespace vantage::reconstruction::detail {

TypeBody::TypeBody(const ObjectType& type) : type_(&type) {
  if (type.mesh->empty()) return;
  Eigen::Vector3f low = type.mesh->vertices().front(), high = low;
  for (const Eigen::Vector3f& vertex : type.mesh->vertices()) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  centre_ = 0.5 * (low + high).cast<double>();
  radius_m_ = 0.5 * (high - low).cast<double>().norm();
}

std::optional<double> TypeBody::depth_behind(const Eigen::Vector3d& from,
                                             const Eigen::Vector3d& to) const {
  std::call_once(built_, [this] {
    SceneBuilder builder;
    builder.add_mesh(*type_->mesh);
    scene_ = builder.build();
  });
  const double distance = (to - from).norm();
  // From as near as can be: floats.
  const double start = std::max(distance - 4 * radius_m_, 0.0);
  if (!(distance > 0) || distance > 1e6) return std::nullopt;
  const Eigen::Vector3d direction = (to - from) / distance;
  const auto hit =
      scene_->closest_hit({(from + start * direction).cast<float>(), direction.cast<float>(), 0.0f,
                           std::numeric_limits<float>::infinity()});
  if (!hit) return std::nullopt;
  return start + double(hit->t) - distance;
}

}  // namespace vantage::reconstruction::detail
