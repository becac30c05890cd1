#include "reasoning/solid_body.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/detail/mesh_measures.hpp"

namespace vantage::reconstruction::detail {
namespace {

using raycore::detail::bounds_of;
using raycore::detail::winding_number;

constexpr std::size_t kSampledVertices = 64;

/// Whether some of the body's points lie in the other one.
bool reaches_into(const TriangleMesh& body, const TriangleMesh& other) {
  const Eigen::AlignedBox3d space = bounds_of(other);
  const auto inside = [&](const Eigen::Vector3d& point) {
    return space.contains(point) && std::abs(winding_number(other, point)) > 0.5;
  };
  if (inside(bounds_of(body).center())) return true;
  const std::size_t step = std::max<std::size_t>(1, body.vertices().size() / kSampledVertices);
  for (std::size_t v = 0; v < body.vertices().size(); v += step) {
    if (inside(body.vertices()[v].cast<double>())) return true;
  }
  return false;
}

}  // namespace

Body::Body(const ReconstructedObject& object, double slack_m) {
  const TriangleMesh& mesh = *object.type->mesh;
  const Eigen::AlignedBox3d bounds = bounds_of(mesh);
  const double shortest = bounds.isEmpty() ? 0 : bounds.sizes().minCoeff();
  const double factor = shortest > 0 ? 1 - 2 * slack_m / shortest : 0;
  if (!(factor > 0.1)) return;
  const Pose to_origin = Pose::from_translation(-bounds.center());
  const Pose back = Pose::from_translation(bounds.center());
  mesh_ = mesh.transformed(to_origin).scaled(factor).transformed(object.T_world_object * back);
}

std::shared_ptr<const Scene> Body::scene() const {
  if (mesh_.empty()) return nullptr;
  SceneBuilder builder;
  builder.add_mesh(mesh_);
  return builder.build();
}

bool overlap(const ReconstructedObject& a, const ReconstructedObject& b, double slack_m) {
  const Body body_a(a, slack_m), body_b(b, slack_m);
  if (body_a.mesh().empty() || body_b.mesh().empty()) return false;
  if (!bounds_of(body_a.mesh()).intersects(bounds_of(body_b.mesh()))) return false;
  return reaches_into(body_a.mesh(), body_b.mesh()) || reaches_into(body_b.mesh(), body_a.mesh());
}

}  // namespace vantage::reconstruction::detail
