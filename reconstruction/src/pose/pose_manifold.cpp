#include "pose/pose_manifold.hpp"

#include <algorithm>
#include <cmath>

namespace vantage::reconstruction::detail {
namespace {

using ConstVector3 = Eigen::Map<const Eigen::Vector3d>;
using ConstQuaternion = Eigen::Map<const Eigen::Quaterniond>;
template <int kRows, int kColumns>
using RowMajor = Eigen::Map<Eigen::Matrix<double, kRows, kColumns, Eigen::RowMajor>>;

}  // namespace

PoseParameters parameters_of(const Pose& pose) {
  const Eigen::Vector3d& t = pose.translation();
  const Eigen::Quaterniond q = pose.quaternion();
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
}

Pose pose_of(const double* parameters) {
  return Pose::from_quaternion(ConstQuaternion(parameters + 3), ConstVector3(parameters));
}

Eigen::Quaterniond exp_of(const Eigen::Vector3d& r) {
  const double angle = r.norm();
  const double scale = angle > 1e-9 ? std::sin(angle / 2) / angle : 0.5;
  Eigen::Quaterniond q;
  q.w() = std::cos(angle / 2);
  q.vec() = scale * r;
  return q;
}

Eigen::Vector3d log_of(const Eigen::Quaterniond& q) {
  const double sine = q.vec().norm(), sign = q.w() < 0 ? -1 : 1;
  const double half = std::atan2(sine, std::abs(q.w()));
  return sign * (sine > 1e-12 ? 2 * half / sine : 2) * q.vec();
}

Eigen::Matrix<double, 3, 4> step_by_quaternion(const Eigen::Quaterniond& q) {
  // Twice the vector part of dq q*.
  Eigen::Matrix<double, 3, 4> m;
  m.leftCols<3>() = 2 * (q.w() * Eigen::Matrix3d::Identity() + cross_matrix(q.vec()));
  m.col(3) = -2 * q.vec();
  return m;
}

bool PoseManifold::Plus(const double* x, const double* step, double* x_plus_step) const {
  Eigen::Map<Eigen::Vector3d> t(x_plus_step);
  Eigen::Map<Eigen::Quaterniond> q(x_plus_step + 3);
  t = ConstVector3(x) + ConstVector3(step);
  q = (exp_of(ConstVector3(step + 3)) * ConstQuaternion(x + 3)).normalized();
  return true;
}

bool PoseManifold::PlusJacobian(const double* x, double* jacobian) const {
  RowMajor<7, 6> m(jacobian);
  m.setZero();
  m.topLeftCorner<3, 3>().setIdentity();
  // exp(r) q is q + (r, 0) q / 2 to first order: a quarter of the transposed inverse, as the
  // columns are orthogonal.
  m.bottomRightCorner<4, 3>() = step_by_quaternion(ConstQuaternion(x + 3)).transpose() / 4;
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  Eigen::Map<Eigen::Matrix<double, 6, 1>> step(y_minus_x);
  step.head<3>() = ConstVector3(y) - ConstVector3(x);
  step.tail<3>() = log_of(ConstQuaternion(y + 3) * ConstQuaternion(x + 3).conjugate());
  return true;
}

bool PoseManifold::MinusJacobian(const double* x, double* jacobian) const {
  RowMajor<6, 7> m(jacobian);
  m.setZero();
  m.topLeftCorner<3, 3>().setIdentity();
  m.bottomRightCorner<3, 4>() = step_by_quaternion(ConstQuaternion(x + 3));
  return true;
}

}  // namespace vantage::reconstruction::detail
