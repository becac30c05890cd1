#include "pose/symmetry.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "pose/rigid_motion.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kSameM = 5e-4, kSameRad = 5e-3;
constexpr int kSweeps = 10;  // for spheres, which have several axes

bool nearly_same(const Pose& a, const Pose& b) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(a.rotation().transpose() * b.rotation()));
  return (a.translation() - b.translation()).norm() <= kSameM && turn.angle() <= kSameRad;
}

}  // namespace

/// With M = R_targetᵀ R and R(φ) = cos φ (I - nnᵀ) + sin φ [n]× + nnᵀ, the trace of M R(φ) is
/// largest at the angle of (tr M (I - nnᵀ), tr M [n]×).
Pose turned_towards(const ContinuousSymmetry& symmetry, const Pose& pose, const Pose& target) {
  const Eigen::Vector3d& n = symmetry.axis;
  const Eigen::Matrix3d m = target.rotation().transpose() * pose.rotation();
  const double sine = (m * cross_matrix(n)).trace(), cosine = m.trace() - n.dot(m * n);
  if (sine == 0 && cosine == 0) return pose;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(std::atan2(sine, cosine), n).toRotationMatrix();
  return pose * Pose::from_rotation(turn, symmetry.offset_m - turn * symmetry.offset_m);
}

Pose turned_towards(const ObjectType& type, const Pose& pose, const Pose& target) {
  const auto& axes = type.symmetries.continuous;
  Pose turned = pose;
  for (int sweep = 0; sweep < (axes.size() > 1 ? kSweeps : 1); ++sweep) {
    for (const ContinuousSymmetry& axis : axes) turned = turned_towards(axis, turned, target);
  }
  return turned;
}

Eigen::Matrix<double, 6, 1> turn_direction(const ContinuousSymmetry& symmetry,
                                           const Pose& T_world_object) {
  const Eigen::Vector3d axis = T_world_object.rotation() * symmetry.axis;
  Eigen::Matrix<double, 6, 1> direction;
  direction << axis.cross(-(T_world_object.rotation() * symmetry.offset_m)), axis;
  return direction;
}

bool equivalent(const ObjectType& type, const Pose& a, const Pose& b) {
  if (nearly_same(turned_towards(type, a, b), b)) return true;
  const auto& discrete = type.symmetries.discrete;
  return std::any_of(discrete.begin(), discrete.end(), [&](const Pose& symmetry) {
    return nearly_same(turned_towards(type, a * symmetry, b), b);
  });
}

}  // namespace vantage::reconstruction::detail
