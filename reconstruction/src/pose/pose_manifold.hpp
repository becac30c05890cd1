#pragma once

#include <ceres/manifold.h>

#include <Eigen/Geometry>
#include <array>

#include "pose/rigid_motion.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage::reconstruction::detail {

/// A pose as Ceres has it: translation, then the unit quaternion as Eigen stores it (x, y, z, w).
using PoseParameters = std::array<double, 7>;

PoseParameters parameters_of(const Pose& pose);
Pose pose_of(const double* parameters);

Eigen::Quaterniond exp_of(const Eigen::Vector3d& rotation_vector);

/// Of length π at most; near to the identity to full precision.
Eigen::Vector3d log_of(const Eigen::Quaterniond& q);

/// SE(3) with steps (t, r) as Matrix6d has them: (exp(r) R, translation + t). Rotations are about
/// the body's origin, so that both halves of a step are nearly independent. Stateless.
class PoseManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* step, double* x_plus_step) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

/// The derivatives of a rotation vector r, for which q changes to exp(r) q, by q.
Eigen::Matrix<double, 3, 4> step_by_quaternion(const Eigen::Quaterniond& q);

}  // namespace vantage::reconstruction::detail
