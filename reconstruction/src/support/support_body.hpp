#pragma once

#include <Eigen/Geometry>
#include <map>
#include <span>
#include <vector>

#include "vantage/raycore/world_model.hpp"
#include "vantage/reconstruction/support.hpp"

// Private: bodies that may touch each other.
namespace vantage::reconstruction::detail {

/// A body where it is said to be; world frame.
struct SupportBody {
  const TriangleMesh* mesh = nullptr;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3d> normals;  ///< of the mesh's triangles, unit length
  Eigen::AlignedBox3d bounds;
  Pose T_world_body;
  Matrix6d covariance = Matrix6d::Zero();
  bool is_fixed = true;
  double mass = 0;  ///< at density 1; 0: unknown
  Eigen::Vector3d centre_of_mass = Eigen::Vector3d::Zero();
  double radius = 0;        ///< no vertex is farther from the pose's origin
  double tilt_sigma = 0;    ///< of its orientation, about the worst axis; radians
  double most_sigma_m = 0;  ///< of no point of it the standard deviation is larger

  /// Of a point's place along a direction, as the pose's covariance has it.
  double variance_at(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) const;
};

/// How a point of a body moves along a direction with the pose's (t, r).
Eigen::Matrix<double, 1, 6> motion_row(const SupportBody& body, const Eigen::Vector3d& point,
                                       const Eigen::Vector3d& direction);

/// Objects first, then structures.
std::vector<SupportBody> support_bodies(std::span<const ReconstructedObject> objects,
                                        std::span<const KnownObject> structures);

}  // namespace vantage::reconstruction::detail
