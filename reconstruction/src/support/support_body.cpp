#include "support/support_body.hpp"

#include <cmath>
#include <map>

#include "vantage/raycore/detail/mesh_measures.hpp"

namespace vantage::reconstruction::detail {
namespace {

using raycore::detail::enclosed_volume;
using raycore::detail::EnclosedVolume;

constexpr double kOpenShare = 1e-3;  ///< of the surface: larger holes leave no volume

SupportBody body_at(const TriangleMesh& mesh, const Pose& T_world_body) {
  SupportBody body;
  body.mesh = &mesh;
  body.T_world_body = T_world_body;
  body.vertices.reserve(mesh.vertices().size());
  for (const Eigen::Vector3f& vertex : mesh.vertices()) {
    body.vertices.push_back(T_world_body * vertex.cast<double>());
  }
  double radius_squared = 0;
  body.normals.reserve(mesh.triangles().size());
  for (const Triangle& triangle : mesh.triangles()) {
    const Eigen::Vector3d& a = body.vertices[triangle[0]];
    const Eigen::Vector3d& b = body.vertices[triangle[1]];
    const Eigen::Vector3d& c = body.vertices[triangle[2]];
    body.normals.push_back((b - a).cross(c - a).normalized());
    for (const Eigen::Vector3d* corner : {&a, &b, &c}) {
      body.bounds.extend(*corner);
      const double squared = (*corner - T_world_body.translation()).squaredNorm();
      radius_squared = std::max(radius_squared, squared);
    }
  }
  body.radius = std::sqrt(radius_squared);
  return body;
}

/// Bodies of one mesh share what it encloses.
class VolumesByMesh {
 public:
  const EnclosedVolume& of(const TriangleMesh& mesh) {
    const auto [at, is_new] = volumes_.try_emplace(&mesh);
    if (is_new) at->second = enclosed_volume(mesh);
    return at->second;
  }

 private:
  std::map<const TriangleMesh*, EnclosedVolume> volumes_;
};

SupportBody movable(const ReconstructedObject& object, VolumesByMesh& volumes) {
  SupportBody body = body_at(*object.type->mesh, object.T_world_object);
  body.is_fixed = false;
  const EnclosedVolume& volume = volumes.of(*object.type->mesh);
  if (volume.volume_m3 > 0 && volume.open_m2.norm() <= kOpenShare * volume.area_m2) {
    body.mass = volume.volume_m3;
    body.centre_of_mass = object.T_world_object * volume.centre;
  }
  if (!object.covariance) return body;
  body.covariance = *object.covariance;
  const double turn = body.covariance.bottomRightCorner<3, 3>().trace();
  body.tilt_sigma = std::sqrt(std::max(0.0, turn));
  body.most_sigma_m = std::sqrt(std::max(0.0, body.covariance.topLeftCorner<3, 3>().trace())) +
                      body.radius * body.tilt_sigma;
  return body;
}

}  // namespace

Eigen::Matrix<double, 1, 6> motion_row(const SupportBody& body, const Eigen::Vector3d& point,
                                       const Eigen::Vector3d& direction) {
  Eigen::Matrix<double, 1, 6> row;
  row.head<3>() = direction.transpose();
  row.tail<3>() = (point - body.T_world_body.translation()).cross(direction).transpose();
  return row;
}

double SupportBody::variance_at(const Eigen::Vector3d& point,
                                const Eigen::Vector3d& direction) const {
  if (most_sigma_m == 0) return 0;
  const Eigen::Matrix<double, 1, 6> row = motion_row(*this, point, direction);
  return std::max(0.0, (row * covariance * row.transpose()).value());
}

std::vector<SupportBody> support_bodies(std::span<const ReconstructedObject> objects,
                                        std::span<const KnownObject> structures) {
  std::vector<SupportBody> bodies;
  bodies.reserve(objects.size() + structures.size());
  VolumesByMesh volumes;
  for (const ReconstructedObject& object : objects) bodies.push_back(movable(object, volumes));
  for (const KnownObject& structure : structures) {
    bodies.push_back(body_at(*structure.mesh, structure.T_world_object));
  }
  return bodies;
}

}  // namespace vantage::reconstruction::detail
